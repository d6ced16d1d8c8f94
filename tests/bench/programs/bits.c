// Bit operations on bytes: CRC-8 of a telegram, counting of set bits, a shift register with feedback, flags.
#include <stdint.h>
#include <stdio.h>

enum { size = 32 };
static uint8_t telegram[size];

static uint8_t crc8(void) {
    uint8_t crc = 255;
    for (int i = 0; i < size; i++) {
        crc = crc ^ telegram[i];
        for (int k = 0; k < 8; k++) {
            if (crc & 0x80)
                crc = (uint8_t)(crc << 1) ^ 29;
            else
                crc = (uint8_t)(crc << 1);
        }
    }
    return crc;
}

static int set_bits(uint8_t value) {
    int count = 0;
    while (value > 0) {
        value = value & (value - 1);
        count = count + 1;
    }
    return count;
}

int main(void) {
    uint8_t state = 1, flags = 0;
    int ones = 0, sum = 0, alarms = 0;
    for (int n = 1; n <= 600000; n++) {
        // The next byte of the telegram: eight steps of the shift register.
        for (int k = 0; k < 8; k++) {
            const uint8_t taps = (state >> 7) ^ (state >> 5) ^ (state >> 4) ^ (state >> 3);
            state = (uint8_t)(state << 1) | (taps & 1);
        }
        telegram[n % size] = state;
        const uint8_t crc = crc8();
        sum = (sum + crc) % 99991;
        ones = (ones + set_bits((uint8_t)~crc)) % 99991;
        if (crc >> (n % 8) & 1)
            flags |= (uint8_t)(1 << crc % 8);
        else
            flags &= (uint8_t) ~(1 << state % 8);
        if ((flags & 129) == 129) alarms = alarms + 1;
    }
    printf("sum %d\nones %d\nalarms %d\n", sum, ones, alarms);
    return 0;
}
