#pragma once

#include <string>

#include "littoral/coupler/fields.hpp"
#include "littoral/coupler/window.hpp"

namespace littoral::coupler {

/// Checks of what is about to cross or has crossed. `who`: whose data it is ("fv_solver"). Each throws
/// CouplingError that names the field and how many of its values are wrong.

/// Arrays of a geometry are as long as n says; coordinates are finite.
void validate(const DonorGeometry& geometry, const std::string& who);
void validate(const Targets& targets, const std::string& who);
/// Arrays are n long, the horizon holds the window, the values of usable cells are finite.
void validate(const DonorValues& values, const DonorGeometry& geometry, const Window& window,
              const std::string& who);
void validate(const Samples& samples, const Targets& targets, const Window& window, const std::string& who);

/// The horizon holds the window.
void validate_horizon(const DonorValues& values, const Window& window, const std::string& who);

/// How many of n values are NaN or infinite where `matters` (null: everywhere) is not 0.
std::size_t count_not_finite(const double* values, std::size_t n, const std::uint8_t* matters = nullptr);

/// Whether all of n doubles are finite; `values` may be bytes of a message, of any alignment.
bool all_finite(const void* values, std::size_t n);

/// Numbers in messages: shortest form of nine digits.
std::string text_of(double number);

}  // namespace littoral::coupler
