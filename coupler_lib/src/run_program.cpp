#include <chrono>
#include <cstdio>
#include <exception>
#include <optional>
#include <thread>

#include "littoral/coupler/job.hpp"
#include "littoral/error.hpp"
#include "validate.hpp"
#include "world.hpp"

namespace littoral::coupler {

namespace {

// Where one cause stops all ranks (a wrong file), the first to speak is rank 0; it ends the job before the
// others repeat it. Where only one of the others stops, this is how much later it speaks.
constexpr std::chrono::milliseconds k_precedence{1500};

struct Place {
  std::int64_t window;
  double time;
};
std::optional<Place> g_place;

std::string place_text(int rank) {
  std::string text = "rank " + std::to_string(rank);
  if (g_place)
    text += ", window " + std::to_string(g_place->window) + ", t = " + text_of(g_place->time) + " s";
  return text;
}

int die(const Job* job, const char* program, const std::string& what) {
  const int rank = job ? job->rank() : world_rank();
  const std::string reason = place_text(rank) + ": " + what;
  const std::string shown = std::string(program) + " " + reason;
  if (world_size() == 1) {  // nobody to take along: no need for the noise of an abort
    std::fprintf(stderr, "%s\n", shown.c_str());
    return 1;
  }
  if (rank != 0) std::this_thread::sleep_for(k_precedence);
  end_world(job ? job->intercomm() : MPI_COMM_NULL, shown, reason);
}

}  // namespace

void set_place(std::int64_t window, double time) { g_place = Place{window, time}; }

int run_program(int argc, char** argv, Role role, const std::string& version,
                const std::function<int(Job&, int, char**)>& body) {
  std::unique_ptr<Job> job;
  const std::string path = argc > 0 ? argv[0] : name(role);
  const std::string program = path.substr(path.find_last_of('/') + 1);
  try {
    job = std::make_unique<Job>(argc, argv, role, version);
    return body(*job, argc, argv);
  } catch (const std::exception& error) {
    return die(job.get(), program.c_str(), error.what());
  } catch (...) {
    return die(job.get(), program.c_str(), "an unknown exception");
  }
}

}  // namespace littoral::coupler
