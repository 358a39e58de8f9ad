#pragma once
// Numbers with the units in which people write them.

/// An SI number with four digits, "3.75 um"; lives until the 8th call after this one.
const char *cli_quantity(double value, const char *si_unit);

/// The same in the unit that suits another number, so that numbers of one line share theirs.
const char *cli_quantity_as(double value, const char *si_unit, double like);

/// A p-value in four digits, "< 1e-300" where no double is as small; lives as long.
const char *cli_p_value(double p);
