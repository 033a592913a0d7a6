/* What models of libraries ask of the simulated chip (chip/ holds it). Times are ticks of the chip's clock, counted from the
 * first statement of main; 64 bits, so that they never come round. Compiled with the types of the user's programs as well as
 * with those of this machine: no floating-point type stands here. */
#ifndef ROBOSMI_HOST_H
#define ROBOSMI_HOST_H
#include <stdarg.h>

typedef unsigned long long host_time;

enum { HOST_HZ = 80000000, HOST_TICKS_PER_MS = HOST_HZ / 1000, HOST_TICKS_PER_US = HOST_HZ / 1000000 };
#define HOST_NEVER (~0ull)

/* ---- time (chip/cogs.c) */
host_time host_now(void);
void host_call(void);                         /* the cost of calling a library's function */
void host_spend(host_time ticks);             /* a computation that takes so long: no other cog is kept waiting */
void host_send_for(host_time ticks);          /* a byte on the console's line takes so long, which is a little faster in some runs */
host_time host_clock_ahead(void);             /* by so much a clock that counts seconds is ahead, in varied runs */
void host_turns(unsigned turns);              /* so many turns of a loop of a library that is compiled as the program is */
void host_sleep_until(host_time when);        /* a blocking wait; varied runs may end it later or earlier */
unsigned host_counter(void);                  /* CNT: the lower 32 bits of the time */
void host_wait_counter(unsigned target);      /* waitcnt: until CNT equals the target, up to 53.7 s */

/* ---- cogs (chip/cogs.c) */
int host_start(void (*function)(void *), void *parameter, int number);  /* number -1: any free one; the cog, or -1 */
void host_stop(int number);
void host_sleep_for_ever(void) __attribute__((noreturn));
int host_self(void);
int host_lock_new(void);                      /* the number of a lock, -1 without one */
void host_lock_return(int number);
int host_lock_set(int number);                /* -1 when it was set already, else 0 */
int host_lock_clear(int number);

/* ---- pins and counters of the cog that asks (chip/pins.c) */
enum { HOST_OUTA, HOST_DIRA, HOST_CTRA, HOST_CTRB, HOST_FRQA, HOST_FRQB, HOST_PHSA, HOST_PHSB, HOST_OTHER, HOST_REGISTERS = 16 };
volatile unsigned *host_register(int which);  /* to read or write; what is written takes effect now */
unsigned host_pins(void);                     /* INA: the levels at all pins */
int host_wait_pins(unsigned mask, unsigned state, int equal, host_time limit);  /* until (INA & mask) == state, or != state: 1; 0 at the limit */
int host_outside_level(int pin);              /* what the world puts on a pin: 0, 1, or 2 for nothing */

/* ---- the world (chip/link.c) */
void host_console_write(int byte);
int host_console_read(host_time limit);       /* the next byte that was typed, -1 at the limit */
int host_millivolts(int channel);             /* the voltage at a channel of the converter */
int host_bus(int scl, int sda);               /* the two-wire bus at these pins: each pair is a bus of its own */
int host_bus_start(int bus, int address, int read);  /* 1 when a device acknowledges */
int host_bus_write(int bus, int byte);
int host_bus_read(int bus);
void host_bus_stop(int bus);
unsigned host_random(void);                   /* 15 bits; another sequence in each varied run */
void host_unmodelled(const char *name) __attribute__((noreturn));  /* ends the run: nothing is known of what would happen */
void host_end(const char *status, const char *cause) __attribute__((noreturn));

/* ---- motions (chip/link.c): how the device at a pin is driven from now on. What of its way is right hangs on that. */
enum { HOST_FOR_A_TIME, HOST_BY_A_WAY, HOST_TO_A_PLACE };  /* until it is told otherwise; so far from its last goal; to an angle */
void host_aims(int pin, int aim);

/* ---- text (chip/text.c): numbers with the machine's own double, which variadic functions receive */
int host_print(char *text, int size, const char *format, va_list values);    /* as vsnprintf */
int host_scan(const char *text, const char *format, va_list places);         /* as vsscanf; %f and %lf read 4 bytes */
int host_double_bits(va_list *values);        /* the next double of a list, as the bits of a float */
#endif
