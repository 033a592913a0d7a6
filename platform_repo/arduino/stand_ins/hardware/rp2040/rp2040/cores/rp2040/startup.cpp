// Reset, clocks, the table of vectors, and what newlib asks of a system.
#include <Arduino.h>
#include <errno.h>
#include <sys/stat.h>

#include "registers.h"

extern "C" {
extern uint32_t stackTop, dataFrom, dataBegin, dataEnd, bssBegin, bssEnd;
extern char end, heapEnd;
extern void (*initBegin[])(), (*initEnd[])();
int main();
void resetHandler();
void hang() {
  for (;;) asm volatile("bkpt 0");
}
}

namespace {

constexpr int INTERRUPTS = 26, FIRST_ALARM = 0, ALARMS = 4;
void (*handlers[INTERRUPTS])();
void (*alarmHandlers[ALARMS])();

void dispatch() {
  uint32_t number;
  asm volatile("mrs %0, ipsr" : "=r"(number));
  void (*handler)() = handlers[(number & 63) - 16];
  if (handler) handler();
}

template <int alarm> void alarmRaised() {
  reg(TIMER_RAISED) = 1u << alarm;
  alarmHandlers[alarm]();
}

void startPll(uint32_t base, uint32_t feedback, uint32_t divider1, uint32_t divider2) {  // 12 MHz * feedback / divider1 / divider2
  reg(base) = 1;
  reg(base + 8) = feedback;
  clearBits(base + 4, 0x21);  // power, oscillator
  while (!(reg(base) >> 31)) {}
  reg(base + 12) = divider1 << 16 | divider2 << 12;
  clearBits(base + 4, 8);
}

void startClocks() {
  constexpr uint32_t mhz = F_CPU / 1000000;
  static_assert(mhz * 6 >= 750 && mhz * 6 <= 1600, "F_CPU: 125 to 266 MHz");
  reg(XOSC + 0xc) = 47;
  reg(XOSC) = 0xfabaa0;
  while (!(reg(XOSC + 4) >> 31)) {}
  reg(CLOCKS + 0x30) = 2;  // the reference clock is the crystal
  while (!(reg(CLOCKS + 0x38) & 4)) {}
  clearBits(CLOCKS + 0x3c, 1);  // the system runs on it while its PLL starts
  while (!(reg(CLOCKS + 0x44) & 1)) {}
  const uint32_t running = ~(1u << 24 | 1u << 6) & 0x1ffffff;  // everything but USB and the flash interface
  clearBits(RESETS, running);
  while (~reg(RESETS + 8) & running) {}
  startPll(PLL_SYS, mhz / 2, 6, 1);
  reg(CLOCKS + 0x3c) = 0;
  setBits(CLOCKS + 0x3c, 1);
  while (!(reg(CLOCKS + 0x44) & 2)) {}
  startPll(PLL_USB, 100, 5, 5);     // 48 MHz
  reg(CLOCKS + 0x48) = 1 << 11;     // peripherals run on the system's clock
  reg(CLOCKS + 0x60) = 1 << 11;     // the converter on 48 MHz
  reg(WATCHDOG + 0x2c) = 12 | 512;  // the tick of 1 us
}

}  // namespace

#define ALL(handler) handler, handler, handler, handler, handler, handler, handler, handler, handler, handler, handler, handler, handler
extern "C" __attribute__((section(".vectors"), used)) void (*const vectors[16 + INTERRUPTS])() = {
    (void (*)()) & stackTop, resetHandler, hang, hang, 0, 0, 0, 0, 0, 0, 0, hang, 0, 0, hang, hang, ALL(dispatch), ALL(dispatch)};

void enableInterrupt(int number) {
  reg(NVIC_FORGET) = 1u << number;
  reg(NVIC_ENABLE) = 1u << number;
}

void irq_set_exclusive_handler(unsigned number, void (*handler)()) { handlers[number] = handler; }
void irq_set_enabled(unsigned number, bool enabled) {
  if (enabled) enableInterrupt(number);
  else reg(NVIC_ENABLE + 0x80) = 1u << number;
}

void handleAlarm(int alarm, void (*handler)()) {
  static void (*const raised[ALARMS])() = {alarmRaised<0>, alarmRaised<1>, alarmRaised<2>, alarmRaised<3>};
  alarmHandlers[alarm] = handler;
  handlers[FIRST_ALARM + alarm] = raised[alarm];
  setBits(TIMER_ENABLED, 1u << alarm);
  enableInterrupt(FIRST_ALARM + alarm);
}

extern "C" void resetHandler() {
  reg(0xe000ed08) = (uint32_t)vectors;
  for (uint32_t *to = &dataBegin, *from = &dataFrom; to < &dataEnd;) *to++ = *from++;
  for (uint32_t *to = &bssBegin; to < &bssEnd;) *to++ = 0;
  startClocks();
  __start_time();
  __start_usb();
  for (auto construct = initBegin; construct < initEnd; construct++) (*construct)();
  main();
  hang();
}

__attribute__((weak)) int main() {
  initVariant();
  setup();
  for (;;) {
    loop();
    if (serialEventRun) serialEventRun();
    if (serialEvent1Run) serialEvent1Run();
    yield();
  }
}

__attribute__((weak)) void initVariant() {}
extern "C" __attribute__((weak)) void yield() {}

void *operator new(size_t size) { return malloc(size); }
void *operator new[](size_t size) { return malloc(size); }
void operator delete(void *place) noexcept { free(place); }
void operator delete[](void *place) noexcept { free(place); }
void operator delete(void *place, size_t) noexcept { free(place); }
void operator delete[](void *place, size_t) noexcept { free(place); }

extern "C" {
void __cxa_pure_virtual() { hang(); }
void *__dso_handle;
void _init() {}
void _fini() {}
void _exit(int) {
  for (;;) hang();
}
int _kill(int, int) { return -1; }
int _getpid() { return 1; }
int _close(int) { return -1; }
int _lseek(int, int, int) { return 0; }
int _isatty(int) { return 1; }
int _fstat(int, struct stat *about) {
  about->st_mode = S_IFCHR;
  return 0;
}
int _read(int, char *, int) { return 0; }
int _write(int, const char *text, int length) { return Serial.write((const uint8_t *)text, length); }  // printf, as in arduino-pico
int _gettimeofday(struct timeval *, void *) {
  errno = ENOSYS;
  return -1;
}
void *_sbrk(int more) {
  static char *top = &end;
  if (top + more > &heapEnd) {
    errno = ENOMEM;
    return (void *)-1;
  }
  char *begin = top;
  top += more;
  return begin;
}
}
