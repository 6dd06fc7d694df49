#pragma once

#include <stdexcept>
#include <string>

namespace littoral {

/// Every error a user can cause or meet. The message says where, what was found, what is allowed, what to do.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The configuration is wrong; holds all problems found, one per line.
struct ConfigError : Error {
  using Error::Error;
};
/// A file cannot be opened, read or written.
struct IoError : Error {
  using Error::Error;
};
/// The partner is absent, late, or says something that does not fit.
struct CouplingError : Error {
  using Error::Error;
};
/// The solution left what the method can represent: NaN, negative volume, lost particle.
struct StabilityError : Error {
  using Error::Error;
};

}  // namespace littoral
