#include "littoral/support/log.hpp"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <array>
#include <cmath>
#include <filesystem>

#include "littoral/error.hpp"
#include "littoral/support/timers.hpp"

namespace littoral::support {
namespace {

std::string seconds_text(double seconds) {
  std::array<char, 40> text{};
  if (!std::isfinite(seconds)) return "?";
  const auto whole = static_cast<long long>(std::llround(seconds));
  if (whole >= 3600)
    std::snprintf(text.data(), text.size(), "%lldh%02lldm", whole / 3600, whole % 3600 / 60);
  else if (whole >= 60)
    std::snprintf(text.data(), text.size(), "%lldm%02llds", whole / 60, whole % 60);
  else
    std::snprintf(text.data(), text.size(), "%llds", whole);
  return text.data();
}

}  // namespace

struct Log::Impl {
  std::unique_ptr<spdlog::logger> console, file;  // null: not ours to write
  double throttle = 0.5;                          // [s] of wall time between progress lines
  double last_progress = -1.0e30;
  double first_time = 0.0;  // of the run's first progress: where a restart began
  double first_wall = -1.0;

  void write(spdlog::level::level_enum level, const std::string& message) {
    // the message is data, not a format
    if (console) console->log(level, "{}", message);
    if (file) file->log(level, "{}", message);
  }
};

Log::Log(const std::string& program, int rank, const std::string& file_path, double seconds)
    : impl_(std::make_unique<Impl>()) {
  impl_->throttle = seconds;
  if (rank == 0) {
    impl_->console =
        std::make_unique<spdlog::logger>(program, std::make_shared<spdlog::sinks::stdout_sink_mt>());
    impl_->console->set_pattern("%n: %v");
    impl_->console->flush_on(spdlog::level::info);
  }
  if (file_path.empty()) return;
  try {
    const auto folder = std::filesystem::path(file_path).parent_path();
    if (!folder.empty()) std::filesystem::create_directories(folder);
    impl_->file = std::make_unique<spdlog::logger>(
        program, std::make_shared<spdlog::sinks::basic_file_sink_mt>(file_path, false));
  } catch (const std::exception& problem) {
    throw IoError(file_path + ": cannot open the log: " + problem.what() + ".");
  }
  impl_->file->set_pattern("%Y-%m-%d %H:%M:%S.%e %n: %v");
  impl_->file->flush_on(spdlog::level::info);
  // a full disk must not fill the console: said once, the run goes on without its log
  impl_->file->set_error_handler([raw = impl_.get(), file_path](const std::string& problem) {
    if (raw->console) raw->console->warn("warning: {}: cannot write the log: {}", file_path, problem);
    raw->file->set_level(spdlog::level::off);
  });
}

Log::~Log() = default;
void Log::info(const std::string& message) { impl_->write(spdlog::level::info, message); }
void Log::warn(const std::string& message) { impl_->write(spdlog::level::warn, "warning: " + message); }

void Log::progress(double time, double end_time, const std::string& details) {
  const double now = Timers::now();
  if (impl_->first_wall < 0.0) {
    impl_->first_wall = now;
    impl_->first_time = time;
  }
  const double advanced = time - impl_->first_time;
  const double remaining =
      advanced > 0.0 ? (now - impl_->first_wall) / advanced * (end_time - time) : INFINITY;
  const double percent = end_time > 0.0 ? 100.0 * time / end_time : 100.0;
  std::array<char, 120> head{};
  std::snprintf(head.data(), head.size(), "t %.6g of %.6g s (%.0f%%), %s left", time, end_time, percent,
                seconds_text(remaining).c_str());
  const std::string line = head.data() + (details.empty() ? "" : "  " + details);
  if (impl_->file) impl_->file->info("{}", line);
  const bool last = time >= end_time;
  if (!impl_->console || (!last && now - impl_->last_progress < impl_->throttle)) return;
  impl_->last_progress = now;
  impl_->console->info("{}", line);
}

}  // namespace littoral::support
