// scree validate: every experiment agrees with theory, at several rates, and reports say what was measured.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "compute/runner.h"
#include "demos/validate/experiment.h"

using namespace scree;
using namespace scree::demos;

namespace {

Lab lab_at(float rate) {
    Settings settings;
    settings.rate = rate;
    return Lab([] { return make_reference_runner(1); }, settings);
}

}  // namespace

TEST_CASE("every experiment agrees with theory, at 60 and 120 steps a second", "[demos]") {
    for (const float rate : {60.0f, 120.0f}) {
        const Lab lab = lab_at(rate);
        for (const Experiment& experiment : all_experiments()) {
            const Validation validation = validate(experiment, lab);
            INFO(validation_table({validation}, true));
            CAPTURE(rate);
            CHECK(validation.samples.size() == experiment.parameters.size());
            CHECK(validation.pass());
        }
    }
}

TEST_CASE("an experiment without result, or with a wrong one, does not pass", "[demos]") {
    Experiment experiment = all_experiments().front();
    experiment.parameters.resize(1);
    const auto passes = [&](double measured) {
        experiment.measure = [=](const Lab&, double) { return measured; };
        return validate(experiment, lab_at(60)).pass();
    };
    const double theory = experiment.theory(experiment.parameters[0]);
    CHECK(passes(theory));
    CHECK_FALSE(passes(theory * 1.1));
    CHECK_FALSE(passes(NAN));
    const Validation interrupted = validate(experiment, lab_at(60), [] { return false; });
    CHECK(interrupted.samples.empty());
    CHECK_FALSE(interrupted.pass());
}

TEST_CASE("a validation's JSON and page hold laws, samples and verdicts", "[demos]") {
    std::vector<Experiment> some = all_experiments();
    some.resize(1);
    some[0].measure = [](const Lab&, double) { return NAN; };
    const std::vector<Validation> all = {validate(some[0], lab_at(60))};
    const auto json = nlohmann::json::parse(validation_json(all, "cpu", "test"));
    CHECK(json.at("experiments").at(0).at("pass") == false);
    CHECK(json.at("experiments").at(0).at("samples").at(0).at("measured").is_null());
    const std::string page = validation_page(all, "a < b");
    CHECK(page.find("a &lt; b") != std::string::npos);
    CHECK(page.find("<svg") != std::string::npos);
    CHECK(page.find("nan") == std::string::npos);
}
