#pragma once

#include <cstdint>

namespace littoral::coupler {

// What makes an HDF5 file a record.
inline constexpr const char* k_format_attribute = "format";
inline constexpr const char* k_format = "littoral record 2";
inline constexpr const char* k_speaker_attribute = "speaker";
inline constexpr const char* k_description_attribute = "description";
inline constexpr const char* k_scene_attribute = "scene";

inline constexpr const char* k_calls_kind = "calls/kind";
inline constexpr const char* k_calls_integers = "calls/window_substeps_count";  // three a call
inline constexpr const char* k_calls_times = "calls/begin_end";                 // two a call

}  // namespace littoral::coupler
