// What a sweep runs: lists of values, and a run for each combination.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace scree::demos {

struct SweptKey {
    std::string key;
    std::vector<std::string> values;
};

// Of "bodies/3/friction=0.1:1.0:10", "seed=1..20", "substeps=4,8,16". Throws CLI::ValidationError.
SweptKey swept_key_of(const std::string& word);

// Combinations of all values, the last key's changing fastest: values of run `index`, in the order of the keys.
std::size_t run_count(const std::vector<SweptKey>& keys);
std::vector<std::string> values_of_run(const std::vector<SweptKey>& keys, std::size_t index);

// The arguments of `scree` for a run; keys such as seed and rate are options, others --set KEY=VALUE.
std::vector<std::string> arguments_of_run(const std::vector<SweptKey>& keys, std::size_t index, const std::string& scene,
                                          const std::vector<std::string>& further);

struct Shard {
    std::size_t number = 1, count = 1;  // number: 1 to count
    bool has(std::size_t run) const { return run % count == number - 1; }
};
Shard shard_of(const std::string& word);  // "2/8"; throws CLI::ValidationError

}  // namespace scree::demos
