// The kinds of bodies that labels of pictures tell apart: categories by name, and models by form.
#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "compute/world.h"
#include "demos/film/export/glb_meshes.h"

namespace scree::demos {

// What a body is called: its name without number ("cup 12", "cup_03" and "cup" are "cup"), of one without a name that of its
// mesh's file, else of its shape.
std::string category_of(const Body& body);

class Categories {
public:
    int number_of(const Body& body);  // from 1, in the order of first use
    const std::vector<std::string>& names() const { return names_; }

private:
    std::map<std::string, int> numbers_;
    std::vector<std::string> names_;
};

// Models as PLY files, in mm, in the frame in which their bodies are described; bodies of one category and equal form share one.
class ModelFiles {
public:
    struct Model {
        std::string name;            // category
        glm::dvec3 low{0}, high{0};  // mm
        double diameter = 0;         // mm, greatest distance of two points
    };

    explicit ModelFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}
    // Number of the body's model, from 1; writes obj_000001.ply and so on when one first comes. Throws host::FileError.
    int number_of(const World& world, std::size_t body);
    const std::vector<Model>& models() const { return models_; }

private:
    std::filesystem::path folder_;
    MeshCollection meshes_;
    std::vector<Shape> kept_;  // whose meshes the collection knows by address
    std::map<std::pair<std::size_t, std::uint32_t>, int> of_bodies_;
    std::map<std::string, int> of_forms_;                                        // by mesh, scale, frame and category
    std::map<std::tuple<std::size_t, std::size_t, std::string>, int> of_files_;  // by hash and length of the file
    std::vector<Model> models_;
};

}  // namespace scree::demos
