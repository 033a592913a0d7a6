//# header pwm2ch.h
// Two pins with pulses of a given width in a common cycle, in the background. Read from Simple-Libraries 1cc167c10,
// Learn/Simple Libraries/Convert/libpwm2ch (pwm2ch.h, pwm2ch.c).
// Each of two devices has a compare interrupt of Timer1, which begins its cycles and ends its pulses, so that any pins serve.

//# type pwm2ch
//#   fidelity: what pwm2ch_start gives; its fields are not those of the library
struct pwm2ch {
  uint32_t cycle_us, asked_us[2];
  uint16_t cycle;                 // ticks of Timer1
  uint16_t begun;                 // when the present cycle did
  uint16_t asked[2], high[2];     // ticks of Timer1, from the next cycle on and in this one
  uint8_t channels;               // bit for each channel in use
  uint8_t open;                   // bit for each channel whose pulse is still to end
  uint8_t mask[2];
  volatile uint8_t *out[2];
  uint8_t pin[2];
};

//# helper pwm2ch_running
//#   needs: pwm2ch
//#   vector: TIMER1_COMPA_vect TIMER1_COMPB_vect
//#   timer: Timer1
//#   ram: 5
static pwm2ch *volatile pwm2ch_running[2];
static uint8_t pwm2ch_shift;  // a tick is 1 << shift cycles of the clock

inline uint16_t pwm2ch_next(pwm2ch *device) {  // does what is due, and tells when the next thing is
  for (;;) {
    uint8_t place = device->open == 3 ? device->high[1] < device->high[0] : device->open >> 1;
    uint16_t due = device->open ? device->high[place] : device->cycle, passed = TCNT1 - device->begun;
    if (passed < due && due - passed > 64U >> pwm2ch_shift) return device->begun + due;
    while ((uint16_t)(TCNT1 - device->begun) < due) {}
    if (device->open) {
      *device->out[place] &= ~device->mask[place];
      device->open &= ~(1 << place);
      continue;
    }
    device->begun += device->cycle;
    for (place = 0; place < 2; place++) {
      device->high[place] = device->asked[place];
      if (!(device->channels & 1 << place)) continue;
      if (!device->high[place]) {
        *device->out[place] &= ~device->mask[place];
        continue;
      }
      *device->out[place] |= device->mask[place];
      if (device->high[place] < device->cycle) device->open |= 1 << place;
    }
  }
}

ISR(TIMER1_COMPA_vect) { OCR1A = pwm2ch_next(pwm2ch_running[0]); }
ISR(TIMER1_COMPB_vect) { OCR1B = pwm2ch_next(pwm2ch_running[1]); }

inline uint16_t pwm2ch_ticks(uint32_t microseconds) {
  uint64_t ticks = (uint64_t)microseconds * clockCyclesPerMicrosecond() >> pwm2ch_shift;
  return min(ticks, (uint64_t)65000);
}

//# adapter pwm2ch_start
//#   for: pwm2ch *pwm2ch_start(unsigned int cycleMicroseconds)
//#   kind: semantic
//#   needs: pwm2ch pwm2ch_running
//#   timer: Timer1
//#   fidelity: cycles from 100 us up to 4.16 s, one tick of the timer exact: 0.06 us up to 4 ms, 0.5 us up to 32 ms; of two devices both
//#   fidelity: have the ticks of the slower one
//#   limit: takes Timer1, which Servo.h needs: one of the two
//#   limit: a third pwm2ch makes no pulses
//#   limit: where a second pwm2ch is so much slower that the ticks change, the first one begins its cycle anew
//#   stack: 33 16
//#   interrupt: TIMER1_COMPA_vect 26
//#   interrupt: TIMER1_COMPB_vect 26
inline pwm2ch *pwm2ch_start(uint32_t cycleMicroseconds) {
  pwm2ch *device = new pwm2ch();
  const uint8_t shifts[] = {0, 0, 3, 6, 8, 10};
  uint8_t clock = 1, place = !pwm2ch_running[0] ? 0 : 1;
  device->cycle_us = cycleMicroseconds;
  if (pwm2ch_running[place]) return device;
  if (pwm2ch_running[!place]) clock = TCCR1B;
  while (clock < 5 && (uint64_t)cycleMicroseconds * clockCyclesPerMicrosecond() >> shifts[clock] > 65000) clock++;
  uint8_t old = SREG;
  cli();
  bool anew = TCCR1B != clock;
  pwm2ch_running[place] = device;
  pwm2ch_shift = shifts[clock];
  TCCR1A = 0;
  TCCR1B = clock;
  for (uint8_t number = 0; number < 2; number++) {
    pwm2ch *each = pwm2ch_running[number];
    if (!each || (each != device && !anew)) continue;
    each->cycle = pwm2ch_ticks(each->cycle_us);
    for (uint8_t channel = 0; channel < 2; channel++) each->asked[channel] = min(pwm2ch_ticks(each->asked_us[channel]), each->cycle);
    each->open = 0;
    each->begun = TCNT1;
    if (number) OCR1B = each->begun + each->cycle;
    else OCR1A = each->begun + each->cycle;
    TIFR1 = number ? _BV(OCF1B) : _BV(OCF1A);
    TIMSK1 |= number ? _BV(OCIE1B) : _BV(OCIE1A);
  }
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
//#   limit: of two devices, the edges of one that fall beside those of the other are up to 20 us late
//#   range: tHigh 20.. or 0: the pulse is not kept
//#   stack: 43 25
//#   interrupt: TIMER1_COMPA_vect 24
//#   interrupt: TIMER1_COMPB_vect 24
inline void pwm2ch_set(pwm2ch *device, int32_t pin, int32_t channel, int32_t tHigh) {
  Io io(pin);
  uint8_t place = channel ? 1 : 0, bit = 1 << place;
  uint8_t old = SREG;
  cli();
  if (device->channels & bit && (tHigh < 0 || device->pin[place] != pin)) {
    device->channels &= ~bit;
    device->open &= ~bit;
    Io before(device->pin[place]);
    before.drive(false);
  }
  SREG = old;
  if (tHigh < 0 || !io.wired()) return;
  uint16_t high = min(pwm2ch_ticks(tHigh), device->cycle);
  cli();
  device->asked_us[place] = tHigh;
  device->asked[place] = high;
  if (!(device->channels & bit)) {
    digitalWrite(pin, LOW);
    io.set(false);
    io.drive_for_library();
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
//#   interrupt: TIMER1_COMPA_vect 24
//#   interrupt: TIMER1_COMPB_vect 24
inline void pwm2ch_stop(pwm2ch *device) {
  pwm2ch_set(device, 255, 0, -1);
  pwm2ch_set(device, 255, 1, -1);
  for (uint8_t place = 0; place < 2; place++) {
    if (pwm2ch_running[place] != device) continue;
    TIMSK1 &= ~(place ? _BV(OCIE1B) : _BV(OCIE1A));
    pwm2ch_running[place] = 0;
  }
  if (!pwm2ch_running[0] && !pwm2ch_running[1]) TCCR1B = 0;
  delete device;
}
