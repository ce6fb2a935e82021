// The C interface: measures of granular media.
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "compute/scene_file/measures_json.h"
#include "demos/c/json.h"
#include "demos/c/objects.h"
#include "demos/film/measure_columns.h"

namespace scree::c {

using nlohmann::json;

namespace {

struct Group {
    std::size_t rows = 0;
    std::map<std::string, std::pair<std::size_t, std::function<std::vector<double>()>>> columns;  // width, values
};

template <class Of>
Group group_of(const std::vector<Of>& rows, const std::vector<demos::MeasureColumn<Of>>& columns) {
    Group group{rows.size(), {}};
    for (const demos::MeasureColumn<Of>& column : columns)
        group.columns[column.name] = {column.width, [rows, column] { return demos::values_of(column, rows); }};
    return group;
}

Group group_of(const GrainMeasures& grains) {
    const auto numbers = [](const auto& from) { return [&from] { return std::vector<double>(from.begin(), from.end()); }; };
    Group group{grains.coordination.size(), {}};
    group.columns["coordination"] = {1, numbers(grains.coordination)};
    group.columns["rattler"] = {1, numbers(grains.rattler)};
    group.columns["stress"] = {9, [&grains] {
                                   std::vector<double> made;
                                   made.reserve(9 * grains.stress.size());
                                   for (const Tensor& one : grains.stress) made.insert(made.end(), one.begin(), one.end());
                                   return made;
                               }};
    return group;
}

// The columns are made when they are asked for; `of` must stay until then.
std::map<std::string, Group> groups_of(const Measures& of) {
    return {{"regions", group_of(demos::regions_with_all(of), demos::region_columns())},
            {"gates", group_of(of.gates, demos::gate_columns())},
            {"bodies", group_of(of.bodies, demos::load_columns())},
            {"grid", group_of(of.grid, demos::cell_columns())},
            {"grains", group_of(of.grains)}};
}

template <class Things>
json names_of(const Things& things) {
    json names = json::array();
    for (const auto& one : things) names.push_back(one.name);
    return names;
}

std::string json_of(const Measures& of) {
    json columns = json::object();
    for (const auto& [name, group] : groups_of(of))
        for (const auto& [column, made] : group.columns) columns[name + "." + column] = made.first;
    return json{
        {"step", of.step},
        {"time", of.time},
        {"cells", {of.cells.x, of.cells.y, of.cells.z}},
        {"names",
         {{"regions", names_of(demos::regions_with_all(of))}, {"gates", names_of(of.gates)}, {"bodies", names_of(of.bodies)}}},
        {"columns", columns}}
        .dump();
}

}  // namespace

}  // namespace scree::c

using namespace scree;
using namespace scree::c;

scree_result scree_world_set_measures(scree_world* world, const char* measures_json, size_t copy) {
    return called([&] {
        const UsedWorld used(world);
        MeasureRequest request = used->shown.measures.value_or(MeasureRequest{});
        if (measures_json != nullptr) {
            const std::string text = text_of(measures_json, "measures_json");
            json_given(measures_json, "measures_json");  // refuses what is nested too deep
            request = measures_from_json(text, used->world.scene());
        }
        used->measuring.emplace(request, used->world, copy);
        used->measured.reset();
    });
}

scree_result scree_world_measure(scree_world* world, const char** text) {
    return called([&] {
        given(text, "json");
        const UsedWorld used(world);
        if (!used->measuring) used->measuring.emplace(used->shown.measures.value_or(MeasureRequest{}), used->world);
        used->measured = used->measuring->take(used->world);
        *text = kept_text(json_of(*used->measured));
    });
}

scree_result scree_world_measured(scree_world* world, const char* column, scree_array* values) {
    return called([&] {
        given(values, "values");
        const UsedWorld used(world);
        const std::string asked = text_of(column, "column");
        if (!used->measured) throw Failure(SCREE_IMPOSSIBLE, "nothing is measured yet: call scree_world_measure first");
        Names known;
        for (const auto& [name, group] : groups_of(*used->measured))
            for (const auto& [of, made] : group.columns) {
                if (asked == name + "." + of) {
                    *values = kept_array(made.second());
                    return;
                }
                known.push_back(name + "." + of);
            }
        refuse(unknown("column", asked, known));
    });
}
