// The first warm start and the four stages of a substep, for several contacts or bodies at once in the lanes of the processor's
// vectors.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree::reference {

// Tables of a State as words.
struct WideTables {
    const std::uint32_t* items;  // contacts or bodies that the stage works on
    const std::uint32_t* parameters;
    const std::uint32_t* properties;
    const std::uint32_t* constraints;
    const std::uint32_t* slot_ends;
    std::uint32_t* poses;
    std::uint32_t* velocities;
    std::uint32_t* masses;
    std::uint32_t* forces;
    std::uint32_t* impulses;
    std::uint32_t* slots;
    const std::uint32_t* told = nullptr;  // a float per body: what it tells of its rest; null but in the last pass
    float* carried = nullptr;             // where bodies may break: of each contact, N s
    std::uint32_t steps = 0;              // Counts::steps in the first substep, whose crowds drift
    bool first = false;
};

// The stages for the items [first, last); the bits are those of the plain loops in contacts.cpp and bodies.cpp.
struct WideStages {
    void (*hand_out)(const WideTables&, std::size_t first, std::size_t last);  // the end of prepare_contacts
    void (*begin)(const WideTables&, std::size_t first, std::size_t last);
    void (*solve)(const WideTables&, std::size_t first, std::size_t last);
    void (*move)(const WideTables&, std::size_t first, std::size_t last);
    void (*relax)(const WideTables&, std::size_t first, std::size_t last);
};

// Those of this processor with at most `most` lanes; null where there are none.
const WideStages* wide_stages(int most);

// compute/cpu/simd/simd_stages.cpp compiled for the vectors that every processor has, for AVX2, and for AVX-512.
extern const WideStages wide_stages_4, wide_stages_8, wide_stages_16;

}  // namespace scree::reference
