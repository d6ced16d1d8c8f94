// The geometry functions of RAPID as a C library, compiled by itself as a library is.
#include "geometry_types.h"

pose pose_mult(pose a, pose b);
pose pose_inv(pose a);
pos pose_vect(pose a, pos p);
orient n_orient(orient q);
pos cross_prod(pos a, pos b);
float dot_prod(pos a, pos b);
float vect_magn(pos a);
