/* propgcc's propeller.h: counter, cogs, locks, waiting for pins. */
#ifndef ROBOSMI_PROPELLER_H
#define ROBOSMI_PROPELLER_H
#include "propeller1.h"
#include <stdint.h>
#include <string.h>
#include <sys/thread.h>
#define HUBDATA
#define HUBTEXT
#define CLKFREQ _clkfreq
#define CLKMODE _clkmode
#define EXTRA_STACK_BYTES 176
#define EXTRA_STACK_LONGS (EXTRA_STACK_BYTES / 4)
/* The clock that the board has already changes nothing. */
#define clkset(mode, frequency) ((mode) == CLKMODE && (frequency) == CLKFREQ ? (void)0 : host_unmodelled("clkset"))
#define cogid() host_self()
#define cognew(code, parameter) (host_unmodelled("cognew"), 0)
#define cogstop(number) host_stop(number)
#define locknew() host_lock_new()
#define lockret(number) host_lock_return(number)
#define lockset(number) host_lock_set(number)
#define lockclr(number) host_lock_clear(number)
#define waitcnt(target) __builtin_propeller_waitcnt((target), 0)
#define waitcnt2(target, delta) __builtin_propeller_waitcnt((target), (delta))
#define waitpeq(state, mask) __builtin_propeller_waitpeq((state), (mask))
#define waitpne(state, mask) __builtin_propeller_waitpne((state), (mask))
#define waitvid(colors, pixels) host_unmodelled("waitvid")
#define use_cog_driver(name) extern uint32_t binary_##name##_dat_start[]
#define get_cog_driver(name) (binary_##name##_dat_start)
#define load_cog_driver(name, parameter) (host_unmodelled("load_cog_driver"), 0)
unsigned int __builtin_propeller_waitcnt(unsigned int target, unsigned int delta);
int __builtin_propeller_rev(int value, int cleared);
void __builtin_propeller_waitpeq(unsigned int state, unsigned int mask);
void __builtin_propeller_waitpne(unsigned int state, unsigned int mask);
int cogstart(void (*function)(void *), void *parameter, void *stack, size_t size);
#define __builtin_propeller_cogid() host_self()
#define __builtin_propeller_cogstop(number) host_stop(number)
#define __builtin_propeller_locknew() host_lock_new()
#define __builtin_propeller_lockret(number) host_lock_return(number)
#define __builtin_propeller_lockset(number) host_lock_set(number)
#define __builtin_propeller_lockclr(number) host_lock_clear(number)
#define __builtin_propeller_coginit(value) (host_unmodelled("coginit"), 0)
#define __builtin_propeller_waitvid(colors, pixels) host_unmodelled("waitvid")
#define __builtin_propeller_clkset(mode) host_unmodelled("clkset")
#endif
