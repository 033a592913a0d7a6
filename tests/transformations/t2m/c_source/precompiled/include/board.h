#ifndef BOARD_H
#define BOARD_H
#include <stdint.h>
#define LED 26
#define SQUARE(x) ((x) * (x))
#ifndef SPEED
#define SPEED 100
#endif
typedef struct { int pin; uint8_t level; } output_t;
enum state { IDLE, BUSY = 5 };
extern volatile unsigned counter;
void set_output(output_t *output, int level);
int get_input(int pin);
static inline int doubled(int x) { return 2 * x; }
#endif
