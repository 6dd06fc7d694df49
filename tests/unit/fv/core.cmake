littoral_gtest(
  NAME fv_core_test
  PREFIX fv
  SOURCES box_test.cpp checkpoint_test.cpp cut_test.cpp elevation_test.cpp
          find_joins_test.cpp
          flows_test.cpp
          free_surface_test.cpp
          generators_test.cpp
          grid_config_test.cpp grid_parts_test.cpp
          joins_test.cpp
          level_set_test.cpp
          measures_test.cpp
          metrics_test.cpp
          openings_test.cpp
          overset_test.cpp
          plot3d_test.cpp
          residual_test.cpp
          stepper_test.cpp surface_velocity_test.cpp
  LIBS fv_core)
