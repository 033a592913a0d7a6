// The pulses are sent one after another: the compare interrupt ends one channel's pulse and begins the next one's, and after
// the last it waits for the rest of the frame, at the begin of which the timer counts from 0. One tick is half a microsecond
// (16 MHz / 8). On a Mega it is Timer5, else Timer1.
#include "Servo.h"

#if defined(__AVR_ATmega2560__)
#define TCNTn TCNT5
#define OCRnA OCR5A
#define TCCRnA TCCR5A
#define TCCRnB TCCR5B
#define TIFRn TIFR5
#define TIMSKn TIMSK5
#define TIMERn_COMPA_vect TIMER5_COMPA_vect
#else
#define TCNTn TCNT1
#define OCRnA OCR1A
#define TCCRnA TCCR1A
#define TCCRnB TCCR1B
#define TIFRn TIFR1
#define TIMSKn TIMSK1
#define TIMERn_COMPA_vect TIMER1_COMPA_vect
#endif

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
int8_t channels;

class NoInterrupts {
 public:
  NoInterrupts() : status(SREG) { cli(); }
  ~NoInterrupts() { SREG = status; }

 private:
  uint8_t status;
};

void startTimer() {
  TCCRnA = 0;
  TCCRnB = _BV(CS11);
  TCNTn = 0;
  OCRnA = 40;
  current = BETWEEN_FRAMES;
  TIFRn = _BV(OCF1A);
  TIMSKn |= _BV(OCIE1A);
}

}  // namespace

ISR(TIMERn_COMPA_vect) {
  if (current == BETWEEN_FRAMES) {
    TCNTn = TCNTn - OCRnA;  // a frame begins at 0
  } else if (active[current]) {
    digitalWrite(pinOf[current], LOW);
  }
  int8_t next = current + 1;
  while (next < channels && !active[next]) next++;
  if (next < channels) {
    current = next;
    digitalWrite(pinOf[next], HIGH);
    OCRnA = TCNTn + width[next] - LATENCY;
  } else {
    current = BETWEEN_FRAMES;
    const uint16_t now = TCNTn;
    OCRnA = now > FRAME - SOONEST ? now + SOONEST : FRAME;
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
  running--;  // frames go on without pulses
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
