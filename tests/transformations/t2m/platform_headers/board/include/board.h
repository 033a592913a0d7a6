/* A small board of our own, for tests: every form of declaration that a platform's header has. */
#ifndef BOARD_H
#define BOARD_H
#include <stdint.h>
#include "bus/wire.h"

#ifdef __cplusplus
extern "C" {
#endif

#define BOARD_LED 13
#define BOARD_CLOCK 16000000L
#define ticks_of(ms) ((ms) * (BOARD_CLOCK / 1000))
#define PORT_OUT (*(volatile uint32_t *)0x40020014u)
#define OUT PORT_OUT
#define INLINE static inline

#ifndef BOARD_PINS
#define BOARD_PINS 24
#endif

typedef enum { MODE_IN, MODE_OUT = 2 } pin_mode_t;
typedef void (*handler_t)(int pin, void *data);
struct channel { int pin; float scale; };
typedef struct channel channel_t;
enum level { LEVEL_LOW, LEVEL_HIGH };

extern volatile uint32_t board_ticks;
extern volatile unsigned int TIMER __asm__("TIMER");
extern const char board_name[];

void board_init(void);
int board_read(int pin);
void board_write(int pin, int level);
unsigned long long board_micros();
char *board_text(channel_t *from, char text[], const char *format, ...);
handler_t board_on_edge(int pin, handler_t handler);
void board_each(void (*visit)(int pin, int level));
INLINE uint32_t board_elapsed(uint32_t since) { return board_ticks - since; }

#ifdef BOARD_REVISION_2
int board_second_revision(void);
#endif

#ifdef __cplusplus
}
#endif
#endif
