/* propeller.h: counter, waiting for pins, cogs. */
#include <propeller.h>

unsigned int _clkfreq = HOST_HZ;
unsigned char _clkmode = 0x6F;

unsigned int __builtin_propeller_waitcnt(unsigned int target, unsigned int delta) {
  host_wait_counter(target);
  return target + delta;
}

void __builtin_propeller_waitpeq(unsigned int state, unsigned int mask) {
  host_call();
  host_wait_pins(mask, state, 1, HOST_NEVER);
}

void __builtin_propeller_waitpne(unsigned int state, unsigned int mask) {
  host_call();
  host_wait_pins(mask, state, 0, HOST_NEVER);
}

int __builtin_propeller_rev(int value, int cleared) {
  unsigned turned = 0;
  for (int bit = 0, bits = 32 - (cleared & 31); bit < bits; bit++) turned |= ((unsigned)value >> bit & 1) << (bits - 1 - bit);
  return turned;
}

int cogstart(void (*function)(void *), void *parameter, void *stack, size_t size) {
  (void)stack, (void)size;
  host_call();
  return host_start(function, parameter, -1);
}

int _start_cog_thread(char *stack_top, void (*function)(void *), void *parameter, _thread_state_t *state) {
  (void)stack_top, (void)state;
  host_call();
  return host_start(function, parameter, -1);
}

int getpin(int pin) {
  OUTA &= ~(1u << pin);
  return INA >> pin & 1;
}

void setpin(int pin, int value) {
  if (value) OUTA |= 1u << pin;
  else OUTA &= ~(1u << pin);
  DIRA |= 1u << pin;
}

void togglepin(int pin) {
  OUTA ^= 1u << pin;
  DIRA |= 1u << pin;
}
