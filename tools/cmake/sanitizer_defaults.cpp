// Compiled into every program of a sanitized build, so that it behaves alike under ctest, mpirun and a
// debugger.

extern "C" {

const char* __lsan_default_suppressions();
const char* __ubsan_default_options();
const char* __lsan_default_options();

/// What Open MPI and its helpers keep until the process ends is not ours to free.
const char* __lsan_default_suppressions() {
  return "leak:libmpi\nleak:libopen-pal\nleak:libopen-rte\nleak:libpmix\nleak:libhwloc\nleak:libevent\n"
         "leak:mca_\nleak:libfabric\nleak:libucp\nleak:libpsm\nleak:libnl\nleak:libgomp\n";
}

/// Without this the list is printed at every exit, in the middle of a test's own output.
const char* __lsan_default_options() { return "print_suppressions=0"; }

const char* __ubsan_default_options() { return "print_stacktrace=1:halt_on_error=1"; }
}
