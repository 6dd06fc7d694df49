#pragma once

#include <string>
#include <vector>

namespace littoral::support {

/// Number of insertions, deletions, replacements and swaps of neighbours that turn one word into the other.
int edit_distance(const std::string& a, const std::string& b);
/// The candidate a misspelt word most likely meant; empty if none is near.
std::string nearest(const std::string& word, const std::vector<std::string>& candidates);
/// "a, b, c"
std::string joined(const std::vector<std::string>& words);

}  // namespace littoral::support
