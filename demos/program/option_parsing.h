// Words of the command line as values, with messages that say what is wrong with them.
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

// A finite number; `such_as` ends the message. Throws CLI::ValidationError naming `option`, as do the others here.
double number_of(const std::string& word, const char* option, const char* such_as = "");
// The same, within what a float holds.
float float_of(const std::string& word, const char* option);
// "1,2.5,-3"
glm::vec3 vector_of(const std::string& word, const char* option);
// What stands before and after the mark.
std::pair<std::string, std::string> halves(const std::string& word, char mark, const char* option, const char* form);

// "1 body", "2 bodies"
std::string counted(std::size_t count, const char* one, const char* many);

// As CLI::Range, which lets NaN pass.
CLI::Validator between(double low, double high);
// One of some words, or a message that names the nearest.
CLI::Validator one_of(std::vector<std::string> known);

// The word of `known` that is nearest to `word` by changed letters; "" if none is near.
std::string nearest(const std::string& word, const std::vector<std::string>& known);

}  // namespace scree::demos
