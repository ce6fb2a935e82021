// Outputs of pictures and numbers: no loss of existing files, no ignored options, correct messages.
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <chrono>

#include "tests/program/program.h"

using scree::program::Outcome;
using scree::program::Place;
using scree::program::run_scree;
using scree::program::says;

namespace {

const std::string brief = "run rest --backend cpu --steps 1 --quiet ";

void require_refused(const std::string& arguments, const std::vector<std::string>& words) {
    const Outcome outcome = run_scree(arguments);
    INFO(arguments << "\n" << outcome.errors);
    REQUIRE(outcome.status == 2);
    REQUIRE(outcome.output.empty());
    for (const std::string& word : words) {
        INFO(word);
        REQUIRE(says(outcome.errors, word));
    }
}

void require_too_large(const Place& place, const std::string& output) {
    const Outcome outcome = run_scree(brief + "--size 640x360 " + output, "ulimit -f 8;");
    INFO(output << "\n" << outcome.errors);
    REQUIRE(outcome.status == 1);
    REQUIRE(says(outcome.errors, "File too large"));
    for (const auto& entry : std::filesystem::recursive_directory_iterator(place.path())) REQUIRE(entry.is_directory());
}

}  // namespace

TEST_CASE("program: a run that is refused replaces no earlier file", "[program][gl]") {
    const Place place;
    for (const std::string option : {"--raw", "--video"}) {
        const std::string file = place.write("earlier.mp4", "earlier");
        // Detected only after the outputs were opened: this canvas draws 8 bits.
        require_refused(brief + "--canvas gl --png-depth 16 " + option + " '" + file + "'", {"8 bits"});
        REQUIRE(place.read("earlier.mp4") == "earlier");
    }
    const auto files = std::filesystem::directory_iterator(place.path());
    REQUIRE(std::distance(begin(files), end(files)) == 1);
}

TEST_CASE("program: a file that may not grow is a failure of the work, and nothing half written is left", "[program]") {
    const Place place;
    require_too_large(place, "--raw '" + place.path().string() + "/raw'");
}

TEST_CASE("program: frames that may not grow are a failure of the work, and nothing half written is left", "[program][vulkan]") {
    const Place place;
    require_too_large(place, "--frames '" + place.path().string() + "/frames' --png-depth 16 --canvas vulkan");
}

TEST_CASE("program: outputs that contradict each other or say nothing are refused", "[program]") {
    const Place place;
    const std::string at = place.path().string();
    require_refused(brief + "--video '" + at + "/clip.avi'", {"clip.avi", "scree.mp4"});
    require_refused(brief + "--raw '" + at + "/a.mp4' --video '" + at + "/./a.mp4'", {"--video and --raw"});
    require_refused(brief + "--raw '" + at + "/a' --report '" + at + "/a'", {"--raw and --report"});
    require_refused(brief + "--report '" + at + "/a.json' --save '" + at + "/a.json'", {"--report and --save"});
    require_refused(brief + "--trace '" + at + "/a.json' --checkpoint '" + at + "/./a.json'", {"--checkpoint and --trace"});
    for (const std::string option : {"--frames", "--video", "--preview", "--raw", "--report"})
        require_refused(brief + option + " ''", {option, "the name is empty"});
    for (const std::string option : {"--color speed", "--png-depth 16", "--no-legend", "--eye 1,2,3", "--camera fit"})
        require_refused("run rest --steps 1 " + option, {option.substr(0, option.find(' ')), "no pictures are asked for"});
    REQUIRE(std::filesystem::is_empty(place.path()));
    REQUIRE(run_scree(brief + "--size 64x48 --raw /dev/null --report /dev/null").status == 0);
}

#ifndef SCREE_THREAD_SANITIZER  // which holds signals back while open() waits
TEST_CASE("program: what waits for another process, for ever, ends at the first signal", "[program]") {
    const Place place;
    const std::string pipe = (place / "pipe.json").string();
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    for (const std::string& arguments : {"run '" + pipe + "'", brief + "--report '" + pipe + "'"}) {
        const auto start = std::chrono::steady_clock::now();
        const Outcome outcome = run_scree(arguments, "timeout 1");
        INFO(arguments << "\n" << outcome.errors);
        REQUIRE(outcome.status == 124);  // timeout's own, after the signal
        REQUIRE(std::chrono::steady_clock::now() - start < std::chrono::seconds(20));
    }
}
#endif

TEST_CASE("program: options that would change nothing are refused", "[program]") {
    require_refused("check --list --report r.json", {"--list and --report"});
    REQUIRE(says(run_scree("check res --backend cpu").errors, "\"res\" is rest"));
    REQUIRE(run_scree("check rest --backend cpu --quiet").errors.empty());
}

TEST_CASE("program: threads are of the processor", "[program][vulkan]") {
    require_refused("run rest --backend vulkan --threads 2", {"--threads", "--backend cpu"});
}

TEST_CASE("program: control characters of a name do not reach the terminal", "[program]") {
    const Outcome outcome = run_scree("run \"$(printf 'no\\033[31msuch')\"");
    REQUIRE(outcome.status == 2);
    REQUIRE(says(outcome.errors, "no\\x1b[31msuch"));
}

TEST_CASE("program: a run that goes on after its promise is judged at its time", "[program]") {
    // After 3 s the fastest box leaves its incline, beyond the promise's duration.
    const Outcome outcome = run_scree("run slopes --backend cpu --seconds 4");
    INFO(outcome.output);
    REQUIRE(outcome.status == 0);
    REQUIRE(says(outcome.output, "acceleration of the rolling sphere"));
}
