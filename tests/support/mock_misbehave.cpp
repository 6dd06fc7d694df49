#include <algorithm>
#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "littoral/error.hpp"
#include "mock.hpp"
#include "payload.hpp"
#include "wire.hpp"

namespace littoral::mock {

using namespace coupler;

bool misbehave_at_begin(const Script& script, std::int64_t window) {
  if (window != script.at) return false;
  const std::string& mode = script.misbehave;
  if (mode == "mute")
    for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
  if (mode == "late") std::this_thread::sleep_for(std::chrono::duration<double>(script.delay));
  if (mode == "killed") std::raise(SIGKILL);
  if (mode == "throws") throw StabilityError("negative density in cell (17,4,0)");
  return mode == "leave-without-goodbye";
}

bool misbehave_in_message(const Script& script, const Job& job, bool donors, const Window& window,
                          std::size_t count) {
  const std::string& mode = script.misbehave;
  const std::vector<std::string> modes{"wrong-window",  "wrong-time",     "wrong-kind",    "wrong-count",
                                       "truncated",     "oversized",      "header-only",   "random-bytes",
                                       "short-horizon", "rest-truncated", "rest-oversized"};
  if (window.index != script.at || std::find(modes.begin(), modes.end(), mode) == modes.end()) return false;
  Expected content;
  content.kind = donors ? Kind::donors : Kind::samples;
  content.epoch = 1;
  content.window = window.index;
  content.time = donors ? window.t_begin : window.t_end;
  if (mode == "wrong-window") content.window -= 1;
  if (mode == "wrong-time") content.time += 1e-3;
  if (mode == "wrong-kind") content.kind = Kind::ledger;
  if (mode == "wrong-count") count += 1;
  Bytes message;
  if (donors) {
    DonorValues values;
    values.time = values.horizon_begin = window.t_begin;
    values.horizon_end = mode == "short-horizon" ? 0.5 * (window.t_begin + window.t_end) : window.t_end;
    values.resize(count, script.with_phi);
    pack(message, values, {{0, count}}, script.with_phi);
  } else {
    Samples samples;
    samples.resize(count, script.with_phi);
    pack(message, samples, 0, count);
  }
  seal(message, content, count);
  if (mode == "truncated") message.resize(message.size() - 8);
  if (mode == "oversized") message.resize(message.size() + 1'000'000, 'x');
  if (mode == "header-only") message.resize(20);
  if (mode == "random-bytes") {
    std::mt19937 random(11);
    for (auto& byte : message) byte = static_cast<char>(random());
  }
  if (mode == "rest-truncated" || mode == "rest-oversized") {  // a long message goes in two pieces
    MPI_Send(message.data(), sizeof(Header), MPI_CHAR, 0, k_tag_message, job.intercomm());
    MPI_Recv(nullptr, 0, MPI_CHAR, 0, k_tag_request, job.intercomm(), MPI_STATUS_IGNORE);
    message.resize(message.size() - 8 + (mode == "rest-truncated" ? 0 : 16));
    MPI_Send(message.data() + sizeof(Header), static_cast<int>(message.size() - sizeof(Header)), MPI_CHAR, 0,
             k_tag_rest, job.intercomm());
    return true;
  }
  MPI_Send(message.data(), static_cast<int>(message.size()), MPI_CHAR, 0, k_tag_message, job.intercomm());
  return true;
}

int play_wrong_version(int argc, char** argv, Role role) {
  MPI_Init(&argc, &argv);
  Greeting mine;
  mine.protocol_version = k_protocol_version + 1;
  const std::string role_name = name(role), program = "mock_from_the_future";
  std::copy(role_name.begin(), role_name.end(), mine.role.begin());
  std::copy(program.begin(), program.end(), mine.program.begin());
  int size = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  std::vector<Greeting> all(static_cast<std::size_t>(size));
  MPI_Request request;
  MPI_Iallgather(&mine, sizeof mine, MPI_BYTE, all.data(), sizeof mine, MPI_BYTE, MPI_COMM_WORLD, &request);
  MPI_Wait(&request, MPI_STATUS_IGNORE);
  for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
}

}  // namespace littoral::mock
