#pragma once
// The lesser and the greater of two numbers in one instruction: fmin and fmax are calls on x86-64,
// for the sake of NaN. Here a NaN gives the second argument.

static inline double lesser_of(double a, double b)
{
    return a < b ? a : b;
}

static inline double greater_of(double a, double b)
{
    return a > b ? a : b;
}
