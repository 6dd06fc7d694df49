#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace littoral::support {

/// The cost of a run by one word, which the scene names for both solvers and each may name otherwise for
/// itself. What it sets are defaults: a key that is given goes before it. What it sets is each solver's own
/// choice, from tables of error and cost (tests/validation/sph_choices, fv_choices).
enum class Fidelity : std::uint8_t { draft, standard, reference };

inline const std::vector<std::pair<std::string, Fidelity>> k_fidelities = {
    {"draft", Fidelity::draft}, {"standard", Fidelity::standard}, {"reference", Fidelity::reference}};

}  // namespace littoral::support
