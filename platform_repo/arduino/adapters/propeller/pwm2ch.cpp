//# header pwm2ch.h
// Two pins with pulses of a given width in a common cycle, in the background. Read from Simple-Libraries 1cc167c10,
// Learn/Simple Libraries/Convert/libpwm2ch (pwm2ch.h, pwm2ch.c).
// Compare interrupts of Timer1 begin the cycle and end the pulses, so that any two pins serve.

//# type pwm2ch
//#   fidelity: what pwm2ch_start gives; its fields are not those of the library
struct pwm2ch {
  uint16_t cycle;                 // ticks of Timer1
  uint8_t channels;               // bit for each channel in use
  uint8_t mask[2];
  volatile uint8_t *out[2];
  uint8_t pin[2];
  uint16_t asked[2], high[2];     // ticks of Timer1, from the next cycle on and in this one
  uint8_t shift;                  // a tick is 1 << shift cycles of the clock
};

//# helper pwm2ch_running
//#   needs: pwm2ch
//#   vector: TIMER1_COMPA_vect TIMER1_COMPB_vect
//#   timer: Timer1
//#   ram: 3
static pwm2ch *volatile pwm2ch_running;
static uint8_t pwm2ch_open;  // bit for each channel whose pulse is still to end

inline void pwm2ch_end() {  // ends pulses that are due, and waits for the next one
  pwm2ch *device = pwm2ch_running;
  uint16_t begun = OCR1A - device->cycle;
  while (pwm2ch_open) {
    uint8_t next = pwm2ch_open == 3 ? device->high[1] < device->high[0] : pwm2ch_open >> 1;
    uint16_t end = device->high[next];
    if ((uint16_t)(TCNT1 - begun) + (64 >> device->shift) < end) {
      OCR1B = begun + end;
      TIFR1 = _BV(OCF1B);
      return;
    }
    while ((uint16_t)(TCNT1 - begun) < end) {}
    *device->out[next] &= ~device->mask[next];
    pwm2ch_open &= ~(1 << next);
  }
}

ISR(TIMER1_COMPA_vect) {
  pwm2ch *device = pwm2ch_running;
  OCR1A += device->cycle;
  pwm2ch_open = 0;
  for (uint8_t place = 0; place < 2; place++) {
    device->high[place] = device->asked[place];
    if (!(device->channels & 1 << place)) continue;
    if (!device->high[place]) {
      *device->out[place] &= ~device->mask[place];
      continue;
    }
    *device->out[place] |= device->mask[place];
    if (device->high[place] < device->cycle) pwm2ch_open |= 1 << place;
  }
  pwm2ch_end();
}

ISR(TIMER1_COMPB_vect) { pwm2ch_end(); }

//# adapter pwm2ch_start
//#   for: pwm2ch *pwm2ch_start(unsigned int cycleMicroseconds)
//#   kind: semantic
//#   needs: pwm2ch pwm2ch_running
//#   timer: Timer1
//#   fidelity: cycles from 100 us up to 4.19 s, one tick of the timer exact: 0.06 us up to 4 ms, 0.5 us up to 32 ms
//#   limit: takes Timer1, which Servo.h needs: one of the two
//#   limit: a second pwm2ch takes the place of the first
//#   stack: 27 14
//#   interrupt: TIMER1_COMPA_vect 34
//#   interrupt: TIMER1_COMPB_vect 27
inline pwm2ch *pwm2ch_start(uint32_t cycleMicroseconds) {
  pwm2ch *device = new pwm2ch();
  uint8_t clock = 1;
  uint64_t cycles = (uint64_t)cycleMicroseconds * clockCyclesPerMicrosecond();
  const uint8_t shifts[] = {0, 0, 3, 6, 8, 10};
  while (clock < 5 && cycles >> shifts[clock] > 65535) clock++;
  device->shift = shifts[clock];
  device->cycle = min(cycles >> shifts[clock], (uint64_t)65535);
  uint8_t old = SREG;
  cli();
  pwm2ch_running = device;
  TCCR1A = 0;
  TCCR1B = clock;
  TCNT1 = 0;
  OCR1A = device->cycle;
  TIFR1 = _BV(OCF1A) | _BV(OCF1B);
  TIMSK1 = _BV(OCIE1A) | _BV(OCIE1B);
  SREG = old;
  return device;
}

//# adapter pwm2ch_set
//#   for: void pwm2ch_set(pwm2ch *device, int pin, int channel, int tHigh)
//#   kind: semantic
//#   needs: pwm2ch pwm2ch_running simpletools.h/Io
//#   pin: pin digital out
//#   fidelity: width within 8 us: the interrupts add up to 5 us; less than nothing ends the pulses, and the pin becomes an input
//#   limit: widths and rests of less than 20 us are not kept
//#   range: tHigh 20.. or 0: the pulse is not kept
//#   stack: 52 29
//#   interrupt: TIMER1_COMPA_vect 34
//#   interrupt: TIMER1_COMPB_vect 27
inline void pwm2ch_set(pwm2ch *device, int32_t pin, int32_t channel, int32_t tHigh) {
  Io io(pin);
  uint8_t place = channel ? 1 : 0, bit = 1 << place;
  uint8_t old = SREG;
  cli();
  if (device->channels & bit && (tHigh < 0 || device->pin[place] != pin)) {
    device->channels &= ~bit;
    pwm2ch_open &= ~bit;
    Io before(device->pin[place]);
    before.drive(false);
  }
  SREG = old;
  if (tHigh < 0 || !io.wired()) return;
  uint64_t ticks = (uint64_t)tHigh * clockCyclesPerMicrosecond() >> device->shift;
  uint16_t high = min(ticks, (uint64_t)device->cycle);
  cli();
  device->asked[place] = high;
  if (!(device->channels & bit)) {
    digitalWrite(pin, LOW);
    io.set(false);
    io.drive(true);
  }
  device->pin[place] = pin;
  device->out[place] = io.out;
  device->mask[place] = io.mask;
  device->channels |= bit;
  SREG = old;
}

//# adapter pwm2ch_stop
//#   for: void pwm2ch_stop(pwm2ch *device)
//#   kind: semantic
//#   needs: pwm2ch pwm2ch_running pwm2ch_set
//#   fidelity: the pins become inputs
//#   stack: 32 28
//#   interrupt: TIMER1_COMPA_vect 34
//#   interrupt: TIMER1_COMPB_vect 27
inline void pwm2ch_stop(pwm2ch *device) {
  pwm2ch_set(device, 255, 0, -1);
  pwm2ch_set(device, 255, 1, -1);
  TIMSK1 = 0;
  TCCR1B = 0;
  pwm2ch_running = 0;
  delete device;
}
