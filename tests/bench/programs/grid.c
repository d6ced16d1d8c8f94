// Arrays of two and three dimensions: the game of life on a plane, heat flow in a block.
#include <stdio.h>
#include <string.h>

enum { width = 96, height = 64, side = 32 };
static int cells[height][width], next[height][width];
static float heat[side][side][side], warmer[side][side][side];

static void generation(void) {
    for (int i = 1; i < height - 1; i++)
        for (int j = 1; j < width - 1; j++) {
            const int near = cells[i - 1][j - 1] + cells[i - 1][j] + cells[i - 1][j + 1] + cells[i][j - 1] +
                             cells[i][j + 1] + cells[i + 1][j - 1] + cells[i + 1][j] + cells[i + 1][j + 1];
            next[i][j] = near == 3 || (near == 2 && cells[i][j] == 1);
        }
    memcpy(cells, next, sizeof cells);
}

static int population(void) {
    int count = 0;
    for (int i = 0; i < height; i++)
        for (int j = 0; j < width; j++)
            count = count + cells[i][j];
    return count;
}

static void flow(float field[side][side][side], float result[side][side][side]) {
    for (int i = 1; i < side - 1; i++)
        for (int j = 1; j < side - 1; j++)
            for (int k = 1; k < side - 1; k++)
                result[i][j][k] =
                    field[i][j][k] + 0.125f * (field[i - 1][j][k] + field[i + 1][j][k] + field[i][j - 1][k] +
                                               field[i][j + 1][k] + field[i][j][k - 1] + field[i][j][k + 1] -
                                               6 * field[i][j][k]);
}

int main(void) {
    int seed = 7, check = 0;
    float sum = 0;
    for (int n = 1; n <= 15000; n++) {
        // A new row of random cells every 50 generations.
        if (n % 50 == 1)
            for (int j = 1; j < width - 1; j++) {
                seed = (seed * 137 + 29) % 30011;
                cells[n % (height - 2) + 1][j] = seed % 2;
            }
        generation();
        if (n % 10 == 0) check = (check * 3 + population()) % 99991;
    }
    printf("check %d population %d\n", check, population());
    for (int n = 1; n <= 3000; n++) {
        heat[n % side][n % 29 + 1][15] = 100;
        flow(heat, warmer);
        flow(warmer, heat);
    }
    for (int i = 0; i < side; i++)
        sum = sum + heat[i][i][side - 1 - i];
    printf("heat %.3f\n", sum);
    return 0;
}
