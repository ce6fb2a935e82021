// Plots of validations as SVG: lines of theory, points that were measured, with bars of their spread.
#pragma once

#include <string>
#include <vector>

namespace scree::demos {

struct PlotPoint {
    double x = 0, y = 0;
    double bar = 0;  // half the length of its bar, in y
};
struct PlotSeries {
    std::string name;  // in the legend; empty: not there
    std::vector<PlotPoint> points;
};
struct PlotOf {
    std::string x, y;               // what the axes are
    std::vector<PlotSeries> lines;  // theory, or what was published
    std::vector<PlotSeries> points;
    bool whole_range = false;                       // all of the band from 0 to the greatest value, not that of the values alone
    bool legend_right = false, legend_low = false;  // where the legend hides no point; else above on the left
};

// `standalone`: a file of its own, with its style in it. Points that are not finite are left out.
std::string svg_plot(const PlotOf& plot, bool standalone = false);
std::string page_style();                      // of a page of plots, as the text of a <style> element
std::string escaped(const std::string& text);  // for HTML and SVG

}  // namespace scree::demos
