// Production counters in global data, changed directly and through pointers.
#include <stdbool.h>
#include <stdio.h>

typedef struct {
    float good, bad, time;
} station;
float produced, shift_time, rejects[6], cycles, history[10];
station press, oven, last;
bool alarm_on;

static void count(float* counter, float amount, float limit) {
    *counter = *counter + amount;
    if (*counter >= limit) *counter = *counter - limit;
}

static void book(station* s, bool good, float time) {
    if (good)
        s->good = s->good + 1;
    else
        s->bad = s->bad + 1;
    s->time = s->time + time;
    if (s->time >= 100000) {
        s->time = s->time - 100000;
        s->good = (float)((int)s->good / 2);
        s->bad = (float)((int)s->bad / 2);
    }
}

static void restart(float* value) {
    *value = 0;
}

int main(void) {
    float alarms = 0, check = 0;
    for (int shift = 1; shift <= 6; shift++)
        for (int n = 1; n <= 8000000; n++) {
            count(&cycles, 1, 100000);
            count(&shift_time, (float)(12 + (int)cycles % 7), 28800);
            const int reason = (int)(cycles * 5 + shift_time) % 11;
            if (reason < 6) {
                rejects[reason] = rejects[reason] + 1;
                alarm_on = (int)rejects[reason] % 100 == 0;
                book(&press, false, 13);
            } else {
                produced = produced + 1;
                book(&press, true, 11);
                book(&oven, reason > 7, (float)((int)shift_time % 50));
            }
            if (alarm_on) alarms = alarms + 1;
            if (produced == 1000) {
                check = (float)((int)(check + press.good + oven.bad + rejects[0]) % 99991);
                restart(&produced);
                history[(int)cycles % 10] = oven.time;
                rejects[0] = 0;
                if (rejects[reason % 6] > 5000) rejects[reason % 6] = 0;
                oven.bad = 0;
                last = press;
            }
        }
    for (int i = 0; i < 10; i++)
        check = (float)((int)(check + history[i]) % 99991);
    printf("produced %.0f time %.0f check %.0f\n", produced, shift_time, check);
    printf("press [%.0f,%.0f,%.0f] oven [%.0f,%.0f,%.0f]\n", press.good, press.bad, press.time, oven.good, oven.bad,
           oven.time);
    printf("last [%.0f,%.0f,%.0f] alarms %.0f\n", last.good, last.bad, last.time, alarms);
    printf("rejects %.0f %.0f\n", rejects[0], rejects[5]);
    return 0;
}
