#pragma once

namespace littoral::support {

/// What the operating system counts of this process, its threads included.
struct ProcessUse {
  double cpu_seconds = 0.0;  // [s] since it began
  double peak_memory = 0.0;  // [bytes] resident at most
};

/// getrusage(2). throws nothing
ProcessUse process_use();

}  // namespace littoral::support
