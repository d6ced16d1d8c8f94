#pragma once
// ProfileGrid: divides a path into the cells on which its speed is found: fine near rest and where limits change, coarse
// elsewhere.

#include "runtime/motion/profile_solver.h"

namespace motion {

struct ProfileGrid {
    ProfileStart start;
    std::vector<ProfileCell> cells;
    double endWidth = 0; ///< mm between the last cell and rest
};

/// `path`: cells from the place where the arm is, moving as in `start` or at rest, to the end of the path; not empty.
/// `firstShare`: below 1 makes the first cells narrower, for a start that leaves little room.
ProfileGrid gridOf(const std::vector<ProfileCell>& path, const ProfileStart& start, double firstShare = 1);

/// The part of a cell between two shares (0 to 1) of its width.
ProfileCell partOf(const ProfileCell& cell, double from, double to);
/// Derivatives and limits between the ends of a cell.
ProfileRows rowsAt(const ProfileCell& cell, double share);

} // namespace motion
