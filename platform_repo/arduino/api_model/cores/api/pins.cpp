// Pins, time and console of the model, by what `board.h` simulates.
#include <Arduino.h>

#include "../../chip/board.h"
#include "pins.h"

SerialPort Serial;

namespace {

// By the number on the board's list: the core's number of the pin, and its channel of the converter or -1
constexpr int16_t NUMBERS[] = {API_PIN_NUMBERS};
constexpr int8_t CHANNELS[] = {API_PIN_CHANNELS};
constexpr int PINS = sizeof NUMBERS / sizeof *NUMBERS;
constexpr float PWM_HZ = 490;
constexpr uint32_t CONVERSION_US = 20;

int inputBits = 10, outputBits = 8;
bool latches[PINS], drives[PINS], waves[PINS];

int found(int number) {
  for (int pin = 0; pin < PINS; pin++)
    if (NUMBERS[pin] == number) return pin;
  return -1;
}

void endWave(int pin) {
  if (waves[pin]) board_wave(pin, 0, 0);
  waves[pin] = false;
}

}  // namespace

extern "C" {

bool apiPinExists(int number) { return found(number) >= 0; }

int32_t apiPin(int number) {
  int pin = found(number);
  if (pin < 0) board_lacks("a pin that the board's data does not have");
  return pin;
}

void api_main() {
  setup();
  for (;;) loop();
}

// ---- pins

void pinMode(pin_size_t number, PinMode mode) {
  int pin = apiPin(number);
  if (mode == INPUT_PULLDOWN) board_lacks("INPUT_PULLDOWN");
  endWave(pin);
  drives[pin] = mode == OUTPUT;
  board_pull_up(pin, mode == INPUT_PULLUP);
  board_drive(pin, mode == OUTPUT ? latches[pin] : BOARD_LET_GO);
}

void digitalWrite(pin_size_t number, PinStatus value) {
  int pin = apiPin(number);
  endWave(pin);
  latches[pin] = value != LOW;
  if (drives[pin]) board_drive(pin, latches[pin]);
}

PinStatus digitalRead(pin_size_t number) { return board_level(apiPin(number)) ? HIGH : LOW; }

void attachInterrupt(pin_size_t number, voidFuncPtr handler, PinStatus mode) {
  if (mode != CHANGE && mode != FALLING && mode != RISING) board_lacks("an interrupt by a level");
  board_attach(apiPin(number), [](void *function) { ((voidFuncPtr)function)(); }, (void *)handler, mode != RISING, mode != FALLING);
}
void detachInterrupt(pin_size_t number) { board_attach(apiPin(number), 0, 0, 0, 0); }
void interrupts() { board_interrupts(1); }
void noInterrupts() { board_interrupts(0); }

// ---- voltages and waves

void analogReadResolution(int bits) { inputBits = bits; }
void analogWriteResolution(int bits) { outputBits = bits; }

int analogRead(pin_size_t number) {
  int pin = found(number);
  if (pin < 0 || CHANNELS[pin] < 0) board_lacks("analogRead() of a pin that measures no voltage");
  board_spend(CONVERSION_US);
  int64_t most = (1 << inputBits) - 1;
  return constrain(board_millivolts(CHANNELS[pin]) * (most + 1) / API_MILLIVOLTS, (int64_t)0, most);
}

void analogWrite(pin_size_t number, int value) {
  int pin = apiPin(number), most = (1 << outputBits) - 1;
  value = constrain(value, 0, most);
  bool level = value == most;
  drives[pin] = true;
  if (value == 0 || level) {
    digitalWrite(number, level ? HIGH : LOW);
    return;
  }
  latches[pin] = false;
  if (!waves[pin]) board_drive(pin, BOARD_LOW);
  board_wave(pin, PWM_HZ, (float)value / (most + 1));
  waves[pin] = true;
}

// ---- time

unsigned long micros() { return board_now(); }
unsigned long millis() { return board_now() / 1000; }

static bool nobodyYields;  // the program has no yield() of its own
__attribute__((weak)) void yield() { nobodyYields = true; }

void delay(unsigned long ms) {
  constexpr uint64_t SLICE = 20;
  uint64_t ends = board_now() + 1000ull * ms;
  for (uint64_t now; (now = board_now()) < ends; board_sleep_until(nobodyYields || now + SLICE > ends ? ends : now + SLICE)) yield();
}

void delayMicroseconds(unsigned int us) { board_sleep_until(board_now() + us); }

// ---- bits

void shiftOut(pin_size_t data, pin_size_t clock, BitOrder order, uint8_t value) {
  for (int place = 0; place < 8; place++) {
    digitalWrite(data, value >> (order == LSBFIRST ? place : 7 - place) & 1 ? HIGH : LOW);
    digitalWrite(clock, HIGH);
    digitalWrite(clock, LOW);
  }
}

uint8_t shiftIn(pin_size_t data, pin_size_t clock, BitOrder order) {
  uint8_t value = 0;
  for (int place = 0; place < 8; place++) {
    digitalWrite(clock, HIGH);
    value |= digitalRead(data) << (order == LSBFIRST ? place : 7 - place);
    digitalWrite(clock, LOW);
  }
  return value;
}

}  // extern "C"

void tone(uint8_t number, unsigned int frequency, unsigned long duration) {
  int pin = apiPin(number);
  endWave(pin);
  drives[pin] = true;
  board_tone(pin, frequency, duration);
}
void noTone(uint8_t number) { board_tone(apiPin(number), 0, 0); }

unsigned long pulseIn(uint8_t number, uint8_t state, unsigned long timeout) {
  int pin = apiPin(number), level = state != 0;
  uint64_t begun = board_now(), from = 0;
  for (int part = 0; part < 3; part++) {  // a pulse that is under way has its end, then the next one comes and ends
    bool wanted = part == 1;
    while ((board_level(pin) == level) != wanted)
      if (board_now() - begun >= timeout) return 0;
    if (wanted) from = board_now();
  }
  return board_now() - from;
}

// ---- console

void SerialPort::begin(unsigned long baud) {
#if !API_USB_CONSOLE
  byteTime = baud ? 10000000 / baud : 0;
#endif
}

int SerialPort::peek() {
  if (next < 0) next = board_get();
  return next;
}

int SerialPort::read() {
  int byte = peek();
  next = -1;
  return byte;
}

size_t SerialPort::write(uint8_t byte) {
  constexpr uint32_t ROOM = 64;
  uint64_t now = board_now();
  if (lineIsFree > now + ROOM * byteTime) board_sleep_until(lineIsFree - ROOM * byteTime);
  lineIsFree = max(lineIsFree, now) + byteTime;
  board_put(byte);
  return 1;
}

void SerialPort::flush() {
  if (lineIsFree > board_now()) board_sleep_until(lineIsFree);
}

#if defined(ARDUINO_ARCH_ESP32)
void xTaskCreatePinnedToCore(void (*task)(void *), const char *, uint32_t, void *argument, unsigned, void **, int) { board_task(task, argument); }
void vTaskDelay(uint32_t ticks) { board_sleep_until(board_now() + 1000ull * ticks); }
#endif

extern "C" {
void *__dso_handle;
int __cxa_atexit(void (*)(void *), void *, void *) { return 0; }  // a sketch does not end
void __cxa_pure_virtual() { board_lacks("a virtual function that no class has"); }
}
void operator delete(void *place) noexcept { free(place); }
void operator delete(void *place, size_t) noexcept { free(place); }
void operator delete[](void *place) noexcept { free(place); }
void operator delete[](void *place, size_t) noexcept { free(place); }
void *operator new(size_t size) { return malloc(size ? size : 1); }
void *operator new[](size_t size) { return malloc(size ? size : 1); }
