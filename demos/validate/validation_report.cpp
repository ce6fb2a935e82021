// Reports of a validation: table, JSON, and a page of plots.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "demos/program/outputs/table.h"
#include "demos/validate/experiment.h"

namespace scree::demos {

namespace {

// A plot's frame in pixels, and the linear scales of its axes.
struct Plot {
    static constexpr double width = 420, height = 260, left = 62, right = 14, top = 14, bottom = 42;
    double x0, x1, y0, y1;

    double x(double value) const { return left + (value - x0) / (x1 - x0) * (width - left - right); }
    double y(double value) const { return height - bottom - (value - y0) / (y1 - y0) * (height - top - bottom); }
};

Plot plot_of(const std::vector<Sample>& samples) {
    Plot plot{samples.front().parameter, samples.front().parameter, samples.front().theory, samples.front().theory};
    for (const Sample& sample : samples) {
        plot.x0 = std::min(plot.x0, sample.parameter);
        plot.x1 = std::max(plot.x1, sample.parameter);
        for (const double value : {sample.theory, std::isfinite(sample.measured) ? sample.measured : sample.theory}) {
            plot.y0 = std::min(plot.y0, value);
            plot.y1 = std::max(plot.y1, value);
        }
    }
    if (plot.x1 == plot.x0) plot.x1 = plot.x0 + 1;
    // A constant is seen in a band of a tenth of its size, so that small errors do not look large.
    const double band = std::max(plot.y1 - plot.y0, std::max(0.1 * std::abs(plot.y1), 1e-6));
    const double middle = (plot.y0 + plot.y1) / 2;
    plot.y0 = middle - 0.55 * band;
    plot.y1 = middle + 0.55 * band;
    return plot;
}

constexpr int curve_points = 40;

// Three to seven round numbers between two limits.
std::vector<double> ticks(double low, double high) {
    const double power = std::pow(10, std::floor(std::log10((high - low) / 3)));
    double step = power;
    for (const double part : {2.0, 5.0, 10.0})
        if ((high - low) / step > 6) step = part * power;
    std::vector<double> made;
    for (double k = std::ceil(low / step); k * step <= high; ++k) made.push_back(std::abs(k) < 0.5 ? 0 : k * step);
    return made;
}

std::string escaped(const std::string& text) {
    std::string made;
    for (const char c : text) made += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
    return made;
}

std::string svg_of(const Validation& validation) {
    const Plot plot = plot_of(validation.samples);
    std::string svg =
        fmt::format("<svg viewBox='0 0 {} {}' width='{}' height='{}'>\n", Plot::width, Plot::height, Plot::width, Plot::height);
    svg += fmt::format("<rect x='{}' y='{}' width='{}' height='{}' class='frame'/>\n", Plot::left, Plot::top,
                       Plot::width - Plot::left - Plot::right, Plot::height - Plot::top - Plot::bottom);
    for (const double x : ticks(plot.x0, plot.x1))
        svg += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='middle'>{:g}</text>\n", plot.x(x), Plot::height - 26, x);
    for (const double y : ticks(plot.y0, plot.y1))
        svg += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='end'>{:g}</text>\n", Plot::left - 5, plot.y(y) + 4, y);
    svg += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='middle'>{}</text>\n",
                       (Plot::left + Plot::width - Plot::right) / 2, Plot::height - 8, escaped(validation.experiment->parameter));
    svg += "<polyline class='theory' points='";
    for (int i = 0; i <= curve_points; ++i) {
        const double x = plot.x0 + (plot.x1 - plot.x0) * i / curve_points;
        svg += fmt::format("{:.1f},{:.1f} ", plot.x(x), plot.y(validation.experiment->theory(x)));
    }
    svg += "'/>\n";
    for (const Sample& sample : validation.samples)
        if (std::isfinite(sample.measured))
            svg += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='4'/>\n", plot.x(sample.parameter), plot.y(sample.measured));
    return svg + "</svg>\n";
}

std::string allowed_of(const Experiment& experiment) {
    std::string text;
    if (experiment.relative > 0) text = fmt::format("{:.3g} %", 100 * experiment.relative);
    if (experiment.absolute > 0) text += fmt::format("{}{:.3g}", text.empty() ? "" : " + ", experiment.absolute);
    return text;
}

constexpr const char* style = R"(<style>
body { font: 15px/1.4 sans-serif; margin: 2em; color: #222; background: #fff }
section { display: inline-block; vertical-align: top; width: 440px; margin: 0 1.5em 1.5em 0 }
h2 { font-size: 1.05em; margin: 0.4em 0 0 } p { margin: 0 0 0.3em } .law { color: #555 } .miss { color: #b00; font-weight: bold }
svg text { font-size: 11px; fill: #444 } .frame { fill: none; stroke: #bbb } .theory { fill: none; stroke: #1f77b4; stroke-width: 2 }
svg circle { fill: #d95f02 }
</style>)";

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
    page += style;
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
