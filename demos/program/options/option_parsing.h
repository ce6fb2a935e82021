// Parsing of command line values, with error messages.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class Validator;
}

namespace scree::demos {

// A finite number; `such_as` (an example) ends the message. All functions here throw CLI::ValidationError naming
// `option`.
double number_of(const std::string& word, const char* option, const char* such_as = "");
// The same, within the range of float.
float float_of(const std::string& word, const char* option);
// "1,2.5,-3"
glm::vec3 vector_of(const std::string& word, const char* option);
// The parts before and after the first `mark`.
std::pair<std::string, std::string> halves(const std::string& word, char mark, const char* option, const char* form);

// "1 body", "2 bodies"
std::string counted(std::size_t count, const char* one, const char* many);

// As CLI::Range, but rejects NaN.
CLI::Validator between(double low, double high);
// One of the known words; the message names the nearest one.
CLI::Validator one_of(std::vector<std::string> known);

// The nearest of the `known` words by edit distance; "" if none is near.
std::string nearest(const std::string& word, const std::vector<std::string>& known);

}  // namespace scree::demos
