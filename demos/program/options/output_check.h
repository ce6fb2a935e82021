// Checks that an output file can be written, before the work.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

namespace scree::demos {

// Throws UsageError, naming the option, unless the file `name` can be created; "" and "-" (standard output) are
// valid.
void require_writable_file(const char* option, const std::string& name);

// Throws UsageError if two options name one file: the later output would replace the other.
struct NamedOutput {
    const char* option;
    std::string name;
};
void require_distinct(std::initializer_list<NamedOutput> outputs);

// Makes a folder of outputs before others are checked, which may be files in it. The destructor removes what it has made if
// that is still empty. A name that cannot be a folder is for others to refuse.
class OutputFolder {
public:
    explicit OutputFolder(const std::filesystem::path& folder);  // empty: none
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

private:
    std::vector<std::filesystem::path> made_;  // innermost first
};

}  // namespace scree::demos
