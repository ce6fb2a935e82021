// Adding the grains of a scene file to its bodies and events, and its bonds to its scene.
#include "compute/scene_file/file_grains.h"

#include <algorithm>
#include <utility>

#include "compute/scene_file/document_fields.h"
#include "compute/scene_file/json_reading.h"
#include "compute/scene_file/pour.h"
#include "compute/schema/check.h"

namespace scree {

namespace {

void add(SceneDocument& document, FileGrains one, const std::string& place, std::vector<std::string>* notes,
         std::size_t most_bodies) {
    const auto note = [&](const GrainSupply& supply) {
        if (notes)
            for (const std::string& told : supply.notes()) notes->push_back(told);
    };
    std::vector<Body>& bodies = document.scene.bodies;
    const std::size_t most = most_bodies - std::min(most_bodies, bodies.size());
    if (one.grains.poured()) {
        note(*supply_of(one.grains, place, std::min(most, most_poured)));
        document.events.push_back({one.start, PourEvent{std::move(one.grains)}});
        return;
    }
    if (one.start != 0) throw SceneError(place + "/start", "is of poured grains; give them a mass_rate or count_rate");
    const GrainSupply supply(one.grains, place, most);
    bodies.reserve(bodies.size() + supply.count());
    supply.place([&](Body body) { bodies.push_back(std::move(body)); });
    note(supply);
}

}  // namespace

void add_bonds(SceneDocument& document) {
    const std::vector<Bonding> all = std::exchange(document.bonds, {});
    const std::size_t before = document.scene.bonds.size();
    try {
        for (std::size_t i = 0; i < all.size(); ++i) add_bonds(document.scene, all[i], "/bonds/" + std::to_string(i));
    } catch (const SceneError&) {
        document.scene.bonds.resize(before);
        document.bonds = all;
        throw;
    }
}

void add_grains(SceneDocument& document, std::vector<std::string>* notes, std::size_t most_bodies) {
    const std::vector<FileGrains> all = std::exchange(document.grains, {});
    const std::size_t bodies = document.scene.bodies.size(), events = document.events.size();
    try {
        for (std::size_t i = 0; i < all.size(); ++i) {
            const std::string place = "/grains/" + std::to_string(i);
            const json_reading::Place root{nullptr, nullptr, 0}, list = root / "grains";
            FileGrains checked = all[i];
            schema::check_fields(list / i, checked);
            add(document, all[i], place, notes, most_bodies);
        }
        check_events(document.events, document.scene);
        if (document.measures) check_measures(*document.measures, document.scene);
    } catch (const SceneError&) {  // as it was
        document.scene.bodies.resize(bodies);
        document.events.resize(events);
        document.grains = all;
        throw;
    }
}

}  // namespace scree
