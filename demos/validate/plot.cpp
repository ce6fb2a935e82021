// Plots as SVG: scales, ticks, lines, points with bars, legends.
#include "demos/validate/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace scree::demos {

namespace {

// A plot's frame in pixels, and the linear scales of its axes.
struct Frame {
    static constexpr double width = 420, height = 260, left = 62, right = 14, top = 14, bottom = 42;
    double x0 = INFINITY, x1 = -INFINITY, y0 = INFINITY, y1 = -INFINITY;

    double x(double value) const { return left + (value - x0) / (x1 - x0) * (width - left - right); }
    double y(double value) const { return height - bottom - (value - y0) / (y1 - y0) * (height - top - bottom); }
    void take(const PlotPoint& point) {
        if (!std::isfinite(point.x) || !std::isfinite(point.y)) return;
        x0 = std::min(x0, point.x);
        x1 = std::max(x1, point.x);
        y0 = std::min(y0, point.y - point.bar);
        y1 = std::max(y1, point.y + point.bar);
    }
};

Frame frame_of(const PlotOf& plot) {
    Frame frame;
    for (const auto* group : {&plot.lines, &plot.points})
        for (const PlotSeries& series : *group)
            for (const PlotPoint& point : series.points) frame.take(point);
    if (!(frame.x1 >= frame.x0)) frame.take({0, 0, 0});
    if (plot.whole_range) {
        frame.y0 = std::min(0.0, frame.y0);
        if (frame.x0 > 0) frame.x0 = 0;
    }
    if (frame.x1 == frame.x0) frame.x1 = frame.x0 + 1;
    // A constant is seen in a band of a tenth of its size, so that small errors do not look large.
    const double band = std::max(frame.y1 - frame.y0, std::max(0.1 * std::abs(frame.y1), 1e-6));
    const double middle = (frame.y0 + frame.y1) / 2;
    frame.y0 = plot.whole_range && frame.y0 == 0 ? 0 : middle - 0.55 * band;
    frame.y1 = middle + 0.55 * band;
    return frame;
}

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

const std::string plot_style =
    "svg text { font: 11px sans-serif; fill: #444 } .frame { fill: none; stroke: #bbb }\n"
    ".theory { fill: none; stroke-width: 2 } .bar { fill: none; stroke-width: 1.2 }\n";
constexpr std::array<const char*, 4> line_colors = {"#1f77b4", "#2a9d8f", "#7b5ea7", "#777"};
constexpr std::array<const char*, 4> point_colors = {"#d95f02", "#1b7837", "#542788", "#444"};

std::string axes(const PlotOf& plot, const Frame& frame) {
    std::string svg = fmt::format("<rect x='{}' y='{}' width='{}' height='{}' class='frame'/>\n", Frame::left, Frame::top,
                                  Frame::width - Frame::left - Frame::right, Frame::height - Frame::top - Frame::bottom);
    for (const double x : ticks(frame.x0, frame.x1))
        svg += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='middle'>{:g}</text>\n", frame.x(x), Frame::height - 26, x);
    for (const double y : ticks(frame.y0, frame.y1))
        svg += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='end'>{:g}</text>\n", Frame::left - 5, frame.y(y) + 4, y);
    svg += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='middle'>{}</text>\n",
                       (Frame::left + Frame::width - Frame::right) / 2, Frame::height - 8, escaped(plot.x));
    if (!plot.y.empty()) {
        const double middle = (Frame::top + Frame::height - Frame::bottom) / 2;
        svg += fmt::format("<text x='14' y='{:.1f}' text-anchor='middle' transform='rotate(-90 14 {:.1f})'>{}</text>\n", middle,
                           middle, escaped(plot.y));
    }
    return svg;
}

std::string marks(const PlotSeries& series, const Frame& frame, const char* color) {
    std::string svg;
    for (const PlotPoint& point : series.points) {
        if (!std::isfinite(point.x) || !std::isfinite(point.y)) continue;
        const double x = frame.x(point.x);
        if (point.bar > 0)
            svg += fmt::format("<path class='bar' stroke='{}' d='M{:.1f} {:.1f}V{:.1f}m-3 0h6M{:.1f} {:.1f}h6'/>\n", color, x,
                               frame.y(point.y - point.bar), frame.y(point.y + point.bar), x - 3, frame.y(point.y - point.bar));
        svg += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='{}' fill='{}'/>\n", x, frame.y(point.y),
                           series.points.size() > 15 ? 2.5 : 4, color);
    }
    return svg;
}

std::string legend(const PlotOf& plot) {
    std::string svg;
    const auto entries = static_cast<double>(plot.lines.size() + plot.points.size());
    double y = plot.legend_low ? Frame::height - Frame::bottom - 15 * entries : Frame::top + 16;
    const double left = plot.legend_right ? Frame::width - 130 : Frame::left + 10;
    const auto entry = [&](const std::string& name, const std::string& mark) {
        if (name.empty()) return;
        svg += mark + fmt::format("<text x='{}' y='{}'>{}</text>\n", left + 24, y + 4, escaped(name));
        y += 15;
    };
    for (std::size_t i = 0; i < plot.lines.size(); ++i)
        entry(plot.lines[i].name, fmt::format("<path class='theory' stroke='{}' d='M{} {}h18'/>", line_colors[i % 4], left, y));
    for (std::size_t i = 0; i < plot.points.size(); ++i)
        entry(plot.points[i].name, fmt::format("<circle cx='{}' cy='{}' r='4' fill='{}'/>", left + 9, y, point_colors[i % 4]));
    return svg;
}

}  // namespace

std::string escaped(const std::string& text) {
    std::string made;
    for (const char c : text) made += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
    return made;
}

std::string page_style() {
    return R"(body { font: 15px/1.4 sans-serif; margin: 2em; color: #222; background: #fff }
section { display: inline-block; vertical-align: top; width: 440px; margin: 0 1.5em 1.5em 0 }
h2 { font-size: 1.05em; margin: 0.4em 0 0 } p { margin: 0 0 0.3em } .law { color: #555 } .miss { color: #b00; font-weight: bold }
)" + plot_style;
}

std::string svg_plot(const PlotOf& plot, bool standalone) {
    const Frame frame = frame_of(plot);
    std::string svg = fmt::format("<svg {}viewBox='0 0 {} {}' width='{}' height='{}'>\n",
                                  standalone ? "xmlns='http://www.w3.org/2000/svg' " : "", Frame::width, Frame::height,
                                  Frame::width, Frame::height);
    if (standalone) svg += "<style>" + plot_style + "</style>\n<rect width='100%' height='100%' fill='#fff'/>\n";
    svg += axes(plot, frame);
    for (std::size_t i = 0; i < plot.lines.size(); ++i) {
        svg += fmt::format("<polyline class='theory' stroke='{}' points='", line_colors[i % 4]);
        for (const PlotPoint& point : plot.lines[i].points)
            if (std::isfinite(point.y)) svg += fmt::format("{:.1f},{:.1f} ", frame.x(point.x), frame.y(point.y));
        svg += "'/>\n";
    }
    for (std::size_t i = 0; i < plot.points.size(); ++i) svg += marks(plot.points[i], frame, point_colors[i % 4]);
    return svg + legend(plot) + "</svg>\n";
}

}  // namespace scree::demos
