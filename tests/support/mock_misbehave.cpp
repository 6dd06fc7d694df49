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

namespace {

/// A long message, whose last column is longer or shorter by `change` bytes than it should be.
void send_with_a_wrong_end(const Outgoing& outgoing, int change, MPI_Comm partner) {
  const auto send = [&](const char* at, std::size_t bytes, int tag) {
    MPI_Send(at, static_cast<int>(bytes), MPI_CHAR, 0, tag, partner);
  };
  const Bytes& message = outgoing.message;
  if (outgoing.columns.empty()) throw ConfigError("mock: this message is too short to go in pieces");
  send(message.data(), sizeof(Header), k_tag_message);
  MPI_Recv(nullptr, 0, MPI_CHAR, 0, k_tag_request, partner, MPI_STATUS_IGNORE);
  send(message.data() + sizeof(Header), message.size() - sizeof(Header), k_tag_rest);
  const Piece last = outgoing.columns.back();
  for (const Piece& column : outgoing.columns)
    if (column.at != last.at) send(column.at, column.bytes, k_tag_rest);
  std::vector<char> wrong(last.at, last.at + last.bytes);
  wrong.resize(static_cast<std::size_t>(static_cast<int>(last.bytes) + change));
  send(wrong.data(), wrong.size(), k_tag_rest);
}

}  // namespace

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
  const std::vector<std::string> modes{"wrong-window",   "wrong-time",    "wrong-kind",  "wrong-count",
                                       "truncated",      "oversized",     "header-only", "random-bytes",
                                       "rest-truncated", "rest-oversized"};
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
  Outgoing outgoing;
  DonorValues values;
  Samples samples;
  if (donors) {
    values.time = values.horizon_begin = window.t_begin;
    values.horizon_end = window.t_end;
    values.resize(count, script.with_phi);
    pack(outgoing, values, {{0, count}}, script.with_phi);
  } else {
    samples.resize(count, script.with_phi);
    pack(outgoing, samples, 0, count);
  }
  seal(outgoing, content, count);
  if (mode == "rest-truncated" || mode == "rest-oversized") {
    send_with_a_wrong_end(outgoing, mode == "rest-truncated" ? -8 : 8, job.intercomm());
    return true;
  }
  outgoing.join();
  Bytes& message = outgoing.message;
  if (mode == "truncated") message.resize(message.size() - 8);
  if (mode == "oversized") message.resize(message.size() + 1'000'000, 'x');
  if (mode == "header-only") message.resize(20);
  if (mode == "random-bytes") {
    std::mt19937 random(11);
    for (auto& byte : message) byte = static_cast<char>(random());
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
