#include <math.h>
#include <stdio.h>

typedef struct {
    double x, y, z, vx, vy, vz, mass;
} body;
enum { count = 5 };
static body bodies[count] = {
    {0, 0, 0, 0, 0, 0, 39.47841760435743},
    {4.84143144246472, -1.16032004402743, -0.103622044471123, 0.606326392995832, 2.81198684491626,
     -0.0252183616598876, 0.0376936749096009},
    {8.34336671824458, 4.12479856412430, -0.403523417114321, -1.01077434617879, 1.82566237123041,
     0.00841576137658415, 0.0112863261319687},
    {12.8943695621391, -15.1111514016986, -0.223307578892656, 1.08279100644153, 0.868713018169608,
     -0.0108326374013636, 0.00172372405705971},
    {15.3796971148509, -25.9193146099880, 0.179258772950371, 0.979090732243898, 0.594698998647676,
     -0.0347559555078104, 0.00203368686992463}};

static void advance(double dt) {
    for (int i = 0; i < count - 1; i++)
        for (int j = i + 1; j < count; j++) {
            const double dx = bodies[i].x - bodies[j].x;
            const double dy = bodies[i].y - bodies[j].y;
            const double dz = bodies[i].z - bodies[j].z;
            const double square = dx * dx + dy * dy + dz * dz;
            const double mag = dt / (square * sqrt(square));
            bodies[i].vx = bodies[i].vx - dx * bodies[j].mass * mag;
            bodies[i].vy = bodies[i].vy - dy * bodies[j].mass * mag;
            bodies[i].vz = bodies[i].vz - dz * bodies[j].mass * mag;
            bodies[j].vx = bodies[j].vx + dx * bodies[i].mass * mag;
            bodies[j].vy = bodies[j].vy + dy * bodies[i].mass * mag;
            bodies[j].vz = bodies[j].vz + dz * bodies[i].mass * mag;
        }
    for (int i = 0; i < count; i++) {
        bodies[i].x = bodies[i].x + dt * bodies[i].vx;
        bodies[i].y = bodies[i].y + dt * bodies[i].vy;
        bodies[i].z = bodies[i].z + dt * bodies[i].vz;
    }
}

static double energy(void) {
    double e = 0;
    for (int i = 0; i < count; i++) {
        e = e + 0.5 * bodies[i].mass *
                    (bodies[i].vx * bodies[i].vx + bodies[i].vy * bodies[i].vy + bodies[i].vz * bodies[i].vz);
        for (int j = i + 1; j < count; j++) {
            const double dx = bodies[i].x - bodies[j].x;
            const double dy = bodies[i].y - bodies[j].y;
            const double dz = bodies[i].z - bodies[j].z;
            e = e - bodies[i].mass * bodies[j].mass / sqrt(dx * dx + dy * dy + dz * dz);
        }
    }
    return e;
}

int main(void) {
    for (int n = 1; n <= 6000000; n++) advance(0.001);
    printf("energy %.6f\n", energy());
    return 0;
}
