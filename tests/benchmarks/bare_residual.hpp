#pragma once

/// Rate of the plainest vectorised residual of the same equations (third order, two wave speeds, BDF2; equal
/// Cartesian cells, one direction after the other, no boundaries, statuses or friction) on n^3 cells, in M
/// cells/s: what the formulas cost on this machine.
double bare_residual_rate(int n, bool limited);
