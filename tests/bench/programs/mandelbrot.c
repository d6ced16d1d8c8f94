#include <stdio.h>

int main(void) {
    int inside = 0;
    for (int row = 1; row <= 300; row++) {
        const float cy = (float)row / 150 - 1;
        for (int column = 1; column <= 300; column++) {
            const float cx = (float)column / 120 - 2;
            float x = 0, y = 0, xx = 0, yy = 0;
            int n = 0;
            while (n < 4000 && xx + yy <= 4) {
                y = 2 * x * y + cy;
                x = xx - yy + cx;
                xx = x * x;
                yy = y * y;
                n = n + 1;
            }
            if (n == 4000) inside = inside + 1;
        }
    }
    printf("inside %d\n", inside);
    return 0;
}
