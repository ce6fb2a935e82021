// Reports of granular validations: tables, JSON, and a page of plots.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "demos/program/outputs/table.h"
#include "demos/validate/granular/granular.h"

namespace scree::demos {

namespace {

std::string accepted_of(const GranularFigure& figure) {
    return fmt::format("{:g} to {:g}", figure.low, figure.high);
}

std::string measured_of(const GranularResult& result, std::size_t figure) {
    return fmt::format("{:.3g} ± {:.2g}", result.mean(figure), result.spread(figure));
}

}  // namespace

std::string granular_table(const std::vector<GranularResult>& all, bool as_markdown) {
    std::vector<Cells> rows = {{"case", "figure", "published", "accepted", "measured", ""}};
    for (const GranularResult& result : all)
        for (std::size_t i = 0; i < result.of->figures.size(); ++i) {
            const GranularFigure& figure = result.of->figures[i];
            rows.push_back({result.of->name, figure.quantity, figure.published, accepted_of(figure), measured_of(result, i),
                            result.pass(i) ? "pass" : "MISS"});
        }
    return as_markdown ? markdown(rows) : table(rows);
}

std::string granular_seeds_table(const std::vector<GranularResult>& all) {
    std::vector<Cells> rows = {{"case", "figure", "seed", "measured"}};
    for (const GranularResult& result : all)
        for (std::size_t i = 0; i < result.of->figures.size(); ++i)
            for (std::size_t seed = 0; seed < result.seeds.size(); ++seed)
                rows.push_back({result.of->name, result.of->figures[i].quantity, fmt::format("{}", seed + 1),
                                fmt::format("{:.5g}", result.seeds[seed].figures[i])});
    return table(rows);
}

std::string granular_list(const std::vector<GranularCase>& cases, bool as_markdown) {
    std::vector<Cells> rows = {{"case", "what", "source", "setup"}};
    for (const GranularCase& granular : cases) rows.push_back({granular.name, granular.title, granular.source, granular.setup});
    return as_markdown ? markdown(rows) : table(rows);
}

std::string granular_json(const std::vector<GranularResult>& all, const std::string& backend, const std::string& device) {
    using Json = nlohmann::ordered_json;
    const auto number = [](double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); };
    Json cases = Json::array();
    for (const GranularResult& result : all) {
        Json figures = Json::array(), points = Json::array();
        for (std::size_t i = 0; i < result.of->figures.size(); ++i) {
            const GranularFigure& figure = result.of->figures[i];
            Json seeds = Json::array();
            for (const GranularMeasured& seed : result.seeds) seeds.push_back(number(seed.figures[i]));
            figures.push_back({{"quantity", figure.quantity},
                               {"published", figure.published},
                               {"low", figure.low},
                               {"high", figure.high},
                               {"mean", number(result.mean(i))},
                               {"spread", number(result.spread(i))},
                               {"seeds", seeds},
                               {"pass", result.pass(i)}});
        }
        const PlotOf plot = result.plot();
        for (const PlotSeries& series : plot.points)
            for (const PlotPoint& point : series.points)
                points.push_back(
                    {{"series", series.name}, {"x", number(point.x)}, {"mean", number(point.y)}, {"spread", number(point.bar)}});
        cases.push_back({{"case", result.of->name},
                         {"title", result.of->title},
                         {"source", result.of->source},
                         {"setup", result.of->setup},
                         {"pass", result.pass()},
                         {"figures", figures},
                         {"x", plot.x},
                         {"y", plot.y},
                         {"points", points}});
    }
    return Json{{"backend", backend}, {"device", device}, {"cases", cases}}.dump(2) + "\n";
}

std::string granular_page(const std::vector<GranularResult>& all, const std::string& heading) {
    std::string page = fmt::format(
        "<!DOCTYPE html>\n<html lang='en'><head><meta charset='utf-8'><title>scree validate granular</title>\n"
        "<style>{}</style></head><body>\n<h1>{}</h1>\n<p>Lines: theory, or what was published. Points: measured, with the "
        "standard deviation over seeds.</p>\n",
        page_style(), escaped(heading));
    for (const GranularResult& result : all) {
        page += fmt::format("<section><h2>{}: {}</h2>\n<p class='law'>{}</p>\n{}", escaped(result.of->name),
                            escaped(result.of->title), escaped(result.of->source), svg_plot(result.plot()));
        for (std::size_t i = 0; i < result.of->figures.size(); ++i)
            page += fmt::format("<p{}>{}: {} (published {}; accepted {})</p>\n", result.pass(i) ? "" : " class='miss'",
                                escaped(result.of->figures[i].quantity), measured_of(result, i),
                                escaped(result.of->figures[i].published), accepted_of(result.of->figures[i]));
        page += fmt::format("<p class='law'>{}</p></section>\n", escaped(result.of->setup));
    }
    return page + "</body></html>\n";
}

}  // namespace scree::demos
