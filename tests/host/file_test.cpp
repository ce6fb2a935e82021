// Atomic file output.
#include <sys/stat.h>

#include <catch2/catch.hpp>

#include "host/files/file.h"
#include "tests/temporary_folder.h"

using namespace scree::host;
using scree::tests::TemporaryFolder;

namespace {

std::size_t entries(const std::filesystem::path& folder) {
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++count;
    return count;
}

}  // namespace

TEST_CASE("a file written is read back with every byte") {
    const TemporaryFolder folder;
    const std::string bytes("a\0b\r\n\xff", 6);
    write_atomically(folder.path() / "file", bytes);
    REQUIRE(read_text(folder.path() / "file") == bytes);
    write_atomically(folder.path() / "file", "");
    REQUIRE(read_text(folder.path() / "file").empty());
    REQUIRE(entries(folder.path()) == 1);
}

TEST_CASE("a file that cannot be written is reported by name and leaves nothing behind") {
    const TemporaryFolder folder;
    make_folder(folder.path() / "taken");
    REQUIRE_THROWS_WITH(write_atomically(folder.path() / "taken", "x"), Catch::Contains("taken") && Catch::Contains("directory"));
    REQUIRE_THROWS_WITH(write_atomically(folder.path() / "missing" / "file", "x"),
                        Catch::Contains("missing/file") && Catch::Contains("No such file"));
    REQUIRE_THROWS_AS(read_text(folder.path() / "missing"), FileError);
    REQUIRE_THROWS_AS(read_text(folder.path()), FileError);
    REQUIRE(entries(folder.path()) == 1);
}

TEST_CASE("writing through a link replaces the file and keeps the link") {
    const TemporaryFolder folder;
    write_atomically(folder.path() / "file", "old");
    std::filesystem::create_symlink(folder.path() / "file", folder.path() / "link");
    write_atomically(folder.path() / "link", "new");
    REQUIRE(std::filesystem::is_symlink(folder.path() / "link"));
    REQUIRE(read_text(folder.path() / "file") == "new");
}

TEST_CASE("a device file is written in place") {
    write_atomically("/dev/null", "x");
    REQUIRE(std::filesystem::is_character_file("/dev/null"));
}

TEST_CASE("of a regular file at most as many bytes as asked for are read, and what is none is refused at once") {
    const TemporaryFolder folder;
    write_atomically(folder.path() / "file", "four");
    REQUIRE(read_regular(folder.path() / "file", 4) == "four");
    REQUIRE_THROWS_WITH(read_regular(folder.path() / "file", 3), Catch::Contains("it has 4 bytes, at most 3 are read"));
    REQUIRE_THROWS_WITH(read_regular("/dev/zero", 1000), Catch::Contains("/dev/zero: it is no regular file"));
    REQUIRE_THROWS_WITH(read_text("/dev/zero"), Catch::Contains("/dev/zero: it is a device, which may never end"));
    REQUIRE_THROWS_AS(read_regular(folder.path(), 1000), FileError);
    const std::filesystem::path pipe = folder.path() / "pipe";
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    REQUIRE_THROWS_WITH(read_regular(pipe, 1000), Catch::Contains("no regular file"));
}

TEST_CASE("folders are made with those above them, and again without complaint") {
    const TemporaryFolder folder;
    make_folder(folder.path() / "a" / "b");
    make_folder(folder.path() / "a" / "b");
    REQUIRE(std::filesystem::is_directory(folder.path() / "a" / "b"));
    write_atomically(folder.path() / "a" / "file", "x");
    REQUIRE_THROWS_WITH(make_folder(folder.path() / "a" / "file"), Catch::Contains("a/file"));
}
