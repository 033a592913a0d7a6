// The pulses are sent one after another: the compare interrupt ends one channel's pulse and begins the next one's, and after
// the last it waits for the rest of the frame. One tick is half a microsecond (16 MHz / 8).
#include "Servo.h"

namespace {

const uint16_t TICKS_PER_US = F_CPU / 8000000UL;
const uint16_t FRAME = static_cast<uint16_t>(REFRESH_INTERVAL * TICKS_PER_US);
const uint16_t LATENCY = 17;    // ticks from the match to the change of the pin, measured with simavr on an Uno
const uint16_t SOONEST = 16;    // ticks that a match must lie ahead to be met
const int8_t BETWEEN_FRAMES = -1;

volatile uint16_t width[MAX_SERVOS];  // ticks
volatile uint8_t pinOf[MAX_SERVOS];
volatile bool active[MAX_SERVOS];
volatile uint8_t running;             // channels that are active
volatile int8_t current = BETWEEN_FRAMES;
volatile uint16_t frameBegan;
int8_t channels;

class NoInterrupts {
 public:
  NoInterrupts() : status(SREG) { cli(); }
  ~NoInterrupts() { SREG = status; }

 private:
  uint8_t status;
};

void startTimer() {
  TCCR1A = 0;
  TCCR1B = _BV(CS11);
  TCNT1 = 0;
  OCR1A = 40;
  TIFR1 = _BV(OCF1A);
  TIMSK1 |= _BV(OCIE1A);
}

}  // namespace

ISR(TIMER1_COMPA_vect) {
  if (current == BETWEEN_FRAMES) {
    frameBegan = OCR1A;
  } else if (active[current]) {
    digitalWrite(pinOf[current], LOW);
  }
  int8_t next = current + 1;
  while (next < channels && !active[next]) next++;
  if (next < channels) {
    current = next;
    digitalWrite(pinOf[next], HIGH);
    OCR1A = TCNT1 + width[next] - LATENCY;
  } else {
    current = BETWEEN_FRAMES;
    const uint16_t now = TCNT1;
    const bool late = static_cast<uint16_t>(now - frameBegan) > static_cast<uint16_t>(FRAME - SOONEST);
    OCR1A = late ? now + SOONEST : frameBegan + FRAME;
  }
}

Servo::Servo() : channel(INVALID_SERVO), lowest(MIN_PULSE_WIDTH), highest(MAX_PULSE_WIDTH) {
  if (channels < MAX_SERVOS) {
    channel = channels++;
    width[channel] = DEFAULT_PULSE_WIDTH * TICKS_PER_US;
  }
}

uint8_t Servo::attach(int pin) { return attach(pin, MIN_PULSE_WIDTH, MAX_PULSE_WIDTH); }

uint8_t Servo::attach(int pin, int min, int max) {
  if (channel == INVALID_SERVO) return INVALID_SERVO;
  lowest = min;
  highest = max;
  pinMode(pin, OUTPUT);
  const NoInterrupts guard;
  if (!running) startTimer();
  pinOf[channel] = pin;
  if (!active[channel]) running++;
  active[channel] = true;
  return channel;
}

void Servo::detach() {
  if (channel == INVALID_SERVO) return;
  const NoInterrupts guard;
  if (!active[channel]) return;
  digitalWrite(pinOf[channel], LOW);
  active[channel] = false;
  if (!--running) {
    TIMSK1 &= ~_BV(OCIE1A);
    current = BETWEEN_FRAMES;
  }
}

void Servo::write(int value) {
  if (value < MIN_PULSE_WIDTH) value = map(constrain(value, 0, 180), 0, 180, lowest, highest);
  writeMicroseconds(value);
}

void Servo::writeMicroseconds(int value) {
  if (channel == INVALID_SERVO) return;
  const uint16_t ticks = static_cast<uint16_t>(constrain(value, lowest, highest)) * TICKS_PER_US;
  const NoInterrupts guard;
  width[channel] = ticks;
}

int Servo::read() { return map(readMicroseconds() + 1, lowest, highest, 0, 180); }

int Servo::readMicroseconds() {
  if (channel == INVALID_SERVO) return 0;
  const NoInterrupts guard;
  return width[channel] / TICKS_PER_US;
}

bool Servo::attached() {
  if (channel == INVALID_SERVO) return false;
  return active[channel];
}
