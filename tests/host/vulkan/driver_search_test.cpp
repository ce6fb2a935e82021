// Vulkan drivers in folders that the loader does not search.
#include "host/vulkan/driver_search.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

using namespace scree::host;
namespace fs = std::filesystem;

TEST_CASE("drivers in unlisted folders are shown to the loader with those it finds, each name once") {
    const fs::path place = fs::temp_directory_path() / "scree_driver_search_test";
    fs::remove_all(place);
    const fs::path listed = place / "listed", unlisted = place / "unlisted", empty = place / "empty";
    for (const fs::path& folder : {listed, unlisted, empty}) fs::create_directories(folder);
    const auto put = [](const fs::path& file) { std::ofstream(file) << "{}"; };
    put(listed / "lvp_icd.json");
    CHECK_FALSE(driver_files({listed}, {place / "missing"}));
    CHECK_FALSE(driver_files({listed}, {empty}));
    put(unlisted / "lvp_icd.json");
    put(unlisted / "README");
    CHECK_FALSE(driver_files({listed}, {unlisted}));
    put(unlisted / "nvidia_icd.json");
    CHECK(driver_files({listed, empty}, {unlisted}) ==
          (listed / "lvp_icd.json").string() + ":" + (unlisted / "nvidia_icd.json").string());
    CHECK(driver_files({empty}, {unlisted}) ==
          (unlisted / "lvp_icd.json").string() + ":" + (unlisted / "nvidia_icd.json").string());
    fs::remove_all(place);
}
