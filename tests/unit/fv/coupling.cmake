# Tests of fv_solver/coupling.
littoral_gtest(
  NAME fv_coupling_test
  PREFIX fv
  SOURCES checks_test.cpp coupling_carve_test.cpp coupling_schedules_test.cpp coupling_surface_test.cpp
          solver_test.cpp
  LIBS fv_core)
