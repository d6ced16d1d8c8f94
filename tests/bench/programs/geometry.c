#include "geometry_library.h"
#include <stdio.h>

int main(void) {
    const pose base = {{100, 0, 300}, {0.965926f, 0, 0, 0.258819f}};
    const pose link = {{0.5f, 0.25f, -0.125f}, {0.999048f, 0.043619f, 0, 0}};
    pose t = base;
    float sum = 0;
    for (int n = 1; n <= 8000; n++) {
        t = base;
        for (int i = 1; i <= 500; i++) {
            t = pose_mult(t, link);
            t.rot = n_orient(t.rot);
            const pos p = pose_vect(t, (pos){1, 2, 3});
            const pose back = pose_inv(t);
            const float cross = vect_magn(cross_prod(p, back.trans));
            if (cross > 100) sum = sum + 1;
            if (dot_prod(p, t.trans) > 90000) sum = sum + 2;
            if (sum > 1000000) sum = 0;
        }
    }
    printf("sum %.0f\n", sum);
    printf("x %.1f y %.1f\n", t.trans.x, t.trans.y);
    return 0;
}
