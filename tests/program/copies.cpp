// Runs of many copies of a scene: the hash of the scene alone, pictures of one and of many, and what is refused.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/program/program.h"

using nlohmann::json;
using scree::program::Outcome;
using scree::program::Place;
using scree::program::run_scree;
using scree::program::says;

namespace {

json report_of(const std::string& words) {
    const Outcome outcome = run_scree("run " + words + " --backend cpu --quiet --report -");
    INFO(outcome.errors);
    REQUIRE(outcome.status == 0);
    return json::parse(outcome.output);
}

void require_refused(const std::string& words, const std::string& reason) {
    const Outcome outcome = run_scree("run " + words + " --backend cpu --steps 1");
    INFO(outcome.errors);
    REQUIRE(outcome.status == 2);
    REQUIRE(says(outcome.errors, reason));
}

}  // namespace

TEST_CASE("program: copies have the hash of the scene alone, or one for each seed and friction", "[program]") {
    const json alone = report_of("bins --steps 20"), five = report_of("bins --steps 20 --copies 5");
    REQUIRE(alone.at("copies").is_null());
    REQUIRE(five.at("copies").at("count") == 5);
    REQUIRE(five.at("copies").at("distinct") == 1);
    REQUIRE(five.at("copies").at("hash") == alone.at("state_hash"));
    REQUIRE(five.at("bodies") == 5 * alone.at("bodies").get<int>());
    const json varied = report_of("bins --steps 20 --copies 4 --vary seed,friction=0.2:0.8 --vary gravity=1.6:9.81");
    REQUIRE(varied.at("copies").at("distinct") == 4);
    REQUIRE(varied.at("copies").at("vary").size() == 3);
    REQUIRE(varied.at("not_finite") == 0);
}

TEST_CASE("program: pictures show copies side by side, or one", "[program]") {
    const Place place;
    const std::string at = place.path().string();
    for (const std::string words : {"", " --copy 2", " --mosaic 2"}) {
        const Outcome outcome =
            run_scree("run stack --copies 3 --steps 2 --fps 1 --size 64x48 --backend cpu --quiet --canvas gl --frames '" + at +
                      "/" + std::to_string(words.size()) + "'" + words);
        INFO(outcome.errors);
        REQUIRE(outcome.status == 0);
        REQUIRE(std::filesystem::exists(place / (std::to_string(words.size()) + "/frame_000000.png")));
    }
    const Outcome saved = run_scree("run stack --copies 3 --copy 1 --steps 2 --backend cpu --quiet --save '" + at + "/one.json'");
    REQUIRE(saved.status == 0);
    REQUIRE(run_scree("run '" + at + "/one.json' --steps 1 --backend cpu --quiet").status == 0);
}

TEST_CASE("program: what runs of copies cannot have is refused", "[program]") {
    require_refused("bins --copies 0", "--copies");
    require_refused("bins --vary friction=0:1", "add --copies N");
    require_refused("bins --copies 3 --vary fricton=0:1", "friction");
    require_refused("bins --copies 3 --vary friction", "needs a range");
    require_refused("bins --copies 3 --vary friction=0:1000", "--vary friction");
    require_refused("bins --copies 3 --vary seed=1:4", "takes no range");
    require_refused("bins --copies 3 --copy 3", "there are 3 copies");
    require_refused("bins --copies 3 --save out.json", "say which with --copy");
    require_refused("bins --copies 3 --export out.glb", "leave out --copies");
    require_refused("fountain --copies 3", "acts on its bodies over time");
}
