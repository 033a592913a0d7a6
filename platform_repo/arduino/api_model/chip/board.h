/* What the model of the Arduino API asks of the simulated board. Pins and channels are numbers of the board's lists, times are
 * microseconds since the program began. Compiled as the program is and as the simulated chip is: only fixed types stand here. */
#ifndef ROBOSMI_BOARD_H
#define ROBOSMI_BOARD_H
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif
enum { BOARD_LOW, BOARD_HIGH, BOARD_LET_GO };

uint64_t board_now(void);                       /* each look costs a call */
void board_sleep_until(uint64_t us);
void board_spend(uint32_t us);

void board_drive(int32_t pin, int32_t level);   /* BOARD_LOW, BOARD_HIGH or BOARD_LET_GO */
void board_pull_up(int32_t pin, int32_t up);
int32_t board_level(int32_t pin);
void board_wave(int32_t pin, float hz, float duty);      /* a timer makes a wave there; 0 Hz ends it */
void board_tone(int32_t pin, uint32_t hz, uint32_t ms);  /* 0 ms: until it is ended by 0 Hz */
void board_servo(int32_t pin, int32_t us);      /* pulses of that width every 20 ms; 0 ends them */
int32_t board_millivolts(int32_t channel);

void board_attach(int32_t pin, void (*handler)(void *), void *argument, int32_t falls, int32_t rises);  /* handler 0: detach */
void board_interrupts(int32_t on);

void board_task(void (*task)(void *), void *argument);  /* runs beside the program */

void board_put(int32_t byte);                   /* a byte leaves on the console */
int32_t board_get(void);                        /* the next byte that was typed, -1 for none */

int32_t board_bus_start(int32_t scl, int32_t sda, int32_t address, int32_t read);  /* 1: a device answers */
int32_t board_bus_write(int32_t scl, int32_t sda, int32_t byte);
int32_t board_bus_read(int32_t scl, int32_t sda);
void board_bus_stop(int32_t scl, int32_t sda);

void board_lacks(const char *name) __attribute__((noreturn));  /* ends the run: the model has no such thing */
#ifdef __cplusplus
}
#endif
#endif
