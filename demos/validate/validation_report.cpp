// Reports of a validation: table, JSON, and a page of plots.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "demos/program/outputs/table.h"
#include "demos/validate/experiment.h"
#include "demos/validate/plot.h"

namespace scree::demos {

namespace {

constexpr int curve_points = 40;

std::string svg_of(const Validation& validation) {
    const Experiment& experiment = *validation.experiment;
    PlotOf plot{.x = experiment.parameter, .y = "", .lines = {}, .points = {}};
    plot.lines.resize(1);
    plot.points.resize(1);
    for (const Sample& sample : validation.samples) plot.points[0].points.push_back({sample.parameter, sample.measured});
    const auto [first, last] = std::minmax_element(validation.samples.begin(), validation.samples.end(),
                                                   [](const Sample& a, const Sample& b) { return a.parameter < b.parameter; });
    for (int i = 0; i <= curve_points; ++i) {
        const double x = first->parameter + (last->parameter - first->parameter) * i / curve_points;
        plot.lines[0].points.push_back({x, experiment.theory(x)});
    }
    return svg_plot(plot);
}

std::string allowed_of(const Experiment& experiment) {
    std::string text;
    if (experiment.relative > 0) text = fmt::format("{:.3g} %", 100 * experiment.relative);
    if (experiment.absolute > 0) text += fmt::format("{}{:.3g}", text.empty() ? "" : " + ", experiment.absolute);
    return text;
}

std::vector<Cells> laws_of(const std::vector<Experiment>& experiments) {
    std::vector<Cells> rows = {{"experiment", "what", "law", "source", "over", "allowed"}};
    for (const Experiment& experiment : experiments)
        rows.push_back(
            {experiment.name, experiment.title, experiment.law, experiment.source, experiment.parameter, allowed_of(experiment)});
    return rows;
}

}  // namespace

std::string validation_table(const std::vector<Validation>& all, bool samples) {
    std::vector<Cells> rows = {{"experiment", "parameter", "", "theory", "measured", "error", "allowed", ""}};
    for (const Validation& validation : all) {
        const Experiment& experiment = *validation.experiment;
        // Without samples, the worst one.
        const auto error = [&](const Sample& s) {
            return std::abs(s.measured - s.theory) / (experiment.relative * std::abs(s.theory) + experiment.absolute);
        };
        std::vector<Sample> shown = validation.samples;
        if (!samples && !shown.empty())
            shown = {*std::max_element(shown.begin(), shown.end(),
                                       [&](const Sample& a, const Sample& b) { return error(a) < error(b); })};
        for (const Sample& s : shown)
            rows.push_back({experiment.name, experiment.parameter, fmt::format("{:g}", s.parameter),
                            fmt::format("{:.5g}", s.theory), fmt::format("{:.5g}", s.measured),
                            fmt::format("{:.2g}", s.measured - s.theory), allowed_of(experiment),
                            error(s) <= 1 ? "pass" : "MISS"});
    }
    return table(rows);
}

std::string validation_json(const std::vector<Validation>& all, const std::string& backend, const std::string& device) {
    nlohmann::ordered_json experiments = nlohmann::ordered_json::array();
    for (const Validation& validation : all) {
        const Experiment& experiment = *validation.experiment;
        nlohmann::ordered_json samples = nlohmann::ordered_json::array();
        for (const Sample& s : validation.samples)
            samples.push_back({{"parameter", s.parameter},
                               {"theory", s.theory},
                               {"measured", std::isfinite(s.measured) ? nlohmann::ordered_json(s.measured) : nullptr}});
        experiments.push_back({{"experiment", experiment.name},
                               {"title", experiment.title},
                               {"law", experiment.law},
                               {"source", experiment.source},
                               {"parameter", experiment.parameter},
                               {"quantity", experiment.quantity},
                               {"allowed_relative", experiment.relative},
                               {"allowed_absolute", experiment.absolute},
                               {"pass", validation.pass()},
                               {"samples", samples}});
    }
    return nlohmann::ordered_json{{"backend", backend}, {"device", device}, {"experiments", experiments}}.dump(2) + "\n";
}

std::string validation_page(const std::vector<Validation>& all, const std::string& heading) {
    std::string page = "<!DOCTYPE html>\n<html lang='en'><head><meta charset='utf-8'><title>scree validate</title>\n";
    page += fmt::format("<style>{}</style>", page_style());
    page += fmt::format("</head><body>\n<h1>{}</h1>\n<p>Lines: theory. Points: measured.</p>\n", escaped(heading));
    for (const Validation& validation : all) {
        const Experiment& experiment = *validation.experiment;
        if (validation.samples.empty()) continue;
        page += fmt::format("<section><h2>{}: {}</h2>\n<p class='law'>{} ({})</p>\n{}", escaped(experiment.name),
                            escaped(experiment.title), escaped(experiment.law), escaped(experiment.source), svg_of(validation));
        page += fmt::format("<p{}>{}; greatest error {:.2g} of the allowed {}</p></section>\n",
                            validation.pass() ? "" : " class='miss'", escaped(experiment.quantity), validation.worst(),
                            escaped(allowed_of(experiment)));
    }
    return page + "</body></html>\n";
}

std::string experiments_of(const std::vector<Experiment>& experiments) {
    return table(laws_of(experiments));
}

std::string experiments_as_markdown(const std::vector<Experiment>& experiments) {
    return markdown(laws_of(experiments));
}

}  // namespace scree::demos
