//# header servo.h
// Servos with pulses in the background, in C. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Motor/libservo (servo.h, servo.c).
// The library's cog makes a pulse for each of 14 servos every 20 ms; here Timer1 makes them one after the other.

//# helper servo_slots
//#   needs: simpletools.h/Io
//#   include: <avr/interrupt.h>
//#   timer: Timer1
//#   vector: TIMER1_COMPA_vect
//#   fidelity: the frame job is due 2 ms before the pulses, so that each pulse has the width of its own frame
//#   fidelity: eight servos at 20 ms, more of them at longer frames
//#   ram: 148
typedef struct {
  uint8_t pin;
  bool used, on, own;         // own: of a drive, which servo_stop and the like leave alone
  int16_t asked, sent, step;  // microseconds; step: at most so many more or less each frame
} ServoSlot;
static volatile ServoSlot servo_slots[14];
static volatile uint8_t servo_now = 14;  // whose pulse it is
static volatile uint8_t *servo_out;      // its PORTx
static uint8_t servo_mask;
enum { servo_counts = F_CPU / 8000000UL };   // of Timer1 in a microsecond

ISR(TIMER1_COMPA_vect) {
  static uint16_t spent, begun;  // microseconds; when this frame began, in counts of Timer1
  if (servo_now < 14) *servo_out &= ~servo_mask;
  else spent = 0, servo_now = -1, begun = OCR1A;
  do servo_now++;
  while (servo_now < 14 && !servo_slots[servo_now].on);
  if (servo_now == 14) {
    if (spent < 19800) OCR1A = begun + 20000U * servo_counts;
    else OCR1A += 200U * servo_counts;
    OCR1B = OCR1A - (spent < 17800 ? 2000U : 150U) * servo_counts;  // when the frame job is due
    return;
  }
  volatile ServoSlot *slot = &servo_slots[servo_now];
  int16_t missing = slot->asked - slot->sent, step = slot->step;
  slot->sent += missing > step ? step : missing < -step ? -step : missing;
  Io io = io_at(slot->pin);
  servo_out = io.in + IO_OUT;
  servo_mask = io.mask;
  OCR1A = TCNT1 + (slot->sent - 3) * servo_counts;  // less the way to the end of the pulse
  *servo_out |= servo_mask;
  spent += slot->sent;
}

static inline volatile ServoSlot *servo_slot(int32_t pin, bool make) {
  volatile ServoSlot *empty = 0;
  for (uint8_t number = 0; number < 14; number++) {
    volatile ServoSlot *slot = &servo_slots[number];
    if (slot->used && slot->pin == pin) return slot;
    if (!slot->used && !empty) empty = slot;
  }
  if (!make || !empty) return 0;
  empty->pin = pin;
  empty->own = false;
  empty->step = 2000;
  empty->used = true;
  return empty;
}

static inline void servo_frames(void) {  // they begin, and go on without a servo
  if (TIMSK1 & _BV(OCIE1A)) return;
  TCCR1A = 0;
  TCCR1B = _BV(CS11);
  OCR1A = TCNT1 + 100;
  TIFR1 = _BV(OCF1A);
  TIMSK1 |= _BV(OCIE1A);
}

static inline void servo_begin(volatile ServoSlot *slot) {
  io_drive(io_at(slot->pin), true);
  servo_frames();
  slot->on = true;
}

static inline void servo_rest(volatile ServoSlot *slot) {  // a pulse under way is ended first
  slot->on = false;
  while (servo_now < 14 && &servo_slots[servo_now] == slot) {}
}

static inline void servo_end(volatile ServoSlot *slot) {
  servo_rest(slot);
  io_drive(io_at(slot->pin), false);
}

//# helper servo_send
//#   needs: servo_slots
//#   include: <avr/interrupt.h>
static inline void servo_send(volatile ServoSlot *slot, int16_t us) {  // the width of the pulses from the next one on
  uint8_t old = SREG;
  cli();
  slot->asked = slot->sent = us;
  SREG = old;
  if (!slot->on) servo_begin(slot);
}

//# helper background
//#   needs: propeller.h/clock_us
//#   include: <avr/interrupt.h>
//#   vector: TIMER0_COMPA_vect
//#   fidelity: sample jobs every 1,024 us with interrupts on
//#   ram: 4
static void (*sample_job)(void);
static void (*each_period)(void);  // of 1,024 us

ISR(TIMER0_COMPA_vect, ISR_NOBLOCK) {
  if (sample_job) sample_job();
  if (each_period) each_period();
}

static inline void count_periods(void) {
  if (!OCR0A) OCR0A = 128;  // not right behind the clock's interrupt of that timer
  TIMSK0 |= _BV(OCIE0A);
}

//# helper frames
//#   needs: background servo_slots simpletools.h/timed_input
//#   include: <avr/interrupt.h>
//#   vector: TIMER1_COMPB_vect
//#   fidelity: a frame job every 20 ms with interrupts on; it waits while an input is timed, and is made up for when that ends
//#   ram: 5
static void (*frame_job)(void);
static volatile uint8_t frames_owed;  // that have waited
static volatile uint8_t frame_age;    // periods of 1,024 us since the frame job began last
static volatile bool frame_job_runs;

static void do_frame_job(void) {
  uint8_t old = SREG;
  cli();
  bool due = frames_owed && frame_age > 7 && !frame_job_runs;
  if (due) frame_job_runs = true, frames_owed--;
  SREG = old;
  if (!due) return;
  frame_job();
  frame_age = 0;
  frame_job_runs = false;
}

static void do_owed_frames(void) {  // all of them, as what comes next may make them wait again
  for (uint8_t owed = frames_owed; owed; owed--) {
    frame_age = 8;
    do_frame_job();
  }
}

static void frame_period(void) {
  if (frame_age < 255) frame_age++;
  if (frames_wait) frames_wait--;
  else do_frame_job();
}

ISR(TIMER1_COMPB_vect) {
  if (frames_owed < 3) frames_owed++;
  sei();
  if (!frames_wait) do_frame_job();
}

static inline void do_each_frame(void (*job)(void)) {
  uint8_t old = SREG;
  cli();
  frame_job = job;
  frames_due = do_owed_frames;
  each_period = frame_period;
  count_periods();
  servo_frames();
  TIFR1 = _BV(OCF1B);
  TIMSK1 |= _BV(OCIE1B);
  SREG = old;
}

//# helper servo_us
//#   fidelity: by the table of the servo at the pin, straight between its points; without one, moved by its neutral pulse
static inline int16_t servo_us(uint8_t pin, int16_t speed, int16_t otherwise) {  // otherwise: microseconds where nobody has measured
#ifdef SERVO_TRIMS
  for (uint8_t number = 0; number < sizeof(servo_trims) / sizeof(*servo_trims); number++) {
    if (servo_trims[number].pin != pin) continue;
    if (!servo_trims[number].points) return otherwise - 1500 + servo_trims[number].neutral;
    const int16_t *at = servo_trims[number].speeds;
    if (speed <= at[0]) return at[1];
    for (uint8_t left = servo_trims[number].points - 1; left; left--, at += 2)
      if (speed <= at[2]) return at[1] + (int32_t)(speed - at[0]) * (at[3] - at[1]) / (at[2] - at[0]);
    return at[1];
  }
#else
  (void)pin;
  (void)speed;
#endif
  return otherwise;
}

//# adapter servo_set
//#   for: int servo_set(int pin, int time)
//#   kind: semantic
//#   needs: servo_slots simpletools.h/Io
//#   include: <avr/interrupt.h>
//#   pin: pin digital out servo
//#   fidelity: widths within 4 us; returns the pin (the target's) at the first call, 1 later, -3 without a free place, as there; 0 us ends the pulses
static inline int32_t servo_set(int32_t pin, int32_t time) {
  if (!io_at(pin).mask) return 0;
  volatile ServoSlot *slot = servo_slot(pin, false);
  int32_t known = slot ? 1 : pin;
  if (!time) {
    if (slot) {
      servo_end(slot);
      slot->used = false;
    }
    return known;
  }
  bool fresh = !slot;
  if (fresh) slot = servo_slot(pin, true);
  if (!slot) return -3;
  uint8_t old = SREG;
  cli();
  slot->asked = time;
  if (fresh || slot->step >= 2000) slot->sent = time;
  SREG = old;
  for (uint8_t number = 0; number < 14; number++)  // those that servo_stop has ended go on, as they do when the library's cog starts again
    if (servo_slots[number].used && !servo_slots[number].own && !servo_slots[number].on) servo_begin(&servo_slots[number]);
  return known;
}

//# adapter servo_angle
//#   for: int servo_angle(int pin, int degreeTenths)
//#   kind: oneToOne
//#   needs: servo_set
//#   pin: pin digital out servo
//#   fidelity: 500 us and one more for each tenth of a degree, as there
static inline int32_t servo_angle(int32_t pin, int32_t degreeTenths) {
  return servo_set(pin, degreeTenths + 500);
}

//# adapter servo_speed
//#   for: int servo_speed(int pin, int speed)
//#   kind: oneToOne
//#   needs: servo_set servo_us
//#   pin: pin digital out servo
//#   fidelity: 1,500 us and one more for each unit, as there; positive is counter-clockwise
static inline int32_t servo_speed(int32_t pin, int32_t speed) {
  int32_t us = speed + 1500;
  return servo_set(pin, us > 0 && us < 3000 ? servo_us(pin, speed, us) : us);
}

//# adapter servo_get
//#   for: int servo_get(int pin)
//#   kind: oneToOne
//#   needs: servo_slots
//#   include: <avr/interrupt.h>
//#   pin: pin digital out servo
//#   fidelity: the width last sent in microseconds, on the way of a ramp too; -4 for a pin without a servo
static inline int32_t servo_get(int32_t pin) {
  volatile ServoSlot *slot = servo_slot(pin, false);
  if (!slot) return -4;
  uint8_t old = SREG;
  cli();
  int16_t sent = slot->sent;
  SREG = old;
  return sent;
}

//# adapter servo_setramp
//#   for: int servo_setramp(int pin, int stepSize)
//#   kind: semantic
//#   needs: servo_slots
//#   include: <avr/interrupt.h>
//#   pin: pin digital out servo
//#   fidelity: at most so many microseconds more or less every 20 ms, in the background; -4 for a pin without a servo
static inline int32_t servo_setramp(int32_t pin, int32_t stepSize) {
  volatile ServoSlot *slot = servo_slot(pin, false);
  if (!slot) return -4;
  uint8_t old = SREG;
  cli();
  slot->step = stepSize;
  SREG = old;
  return pin;
}

//# adapter servo_disable
//#   for: int servo_disable(int pin)
//#   kind: oneToOne
//#   needs: servo_set
//#   pin: pin digital out servo
//#   fidelity: as there: the pin becomes an input; a pulse under way is ended first, for which it waits up to 3 ms
static inline int32_t servo_disable(int32_t pin) {
  return servo_set(pin, 0);
}

//# adapter servo_stop
//#   for: void servo_stop(void)
//#   kind: oneToMany
//#   needs: servo_slots
//#   fidelity: all pulses end and the pins become inputs; they go on with the next call of servo_set and its like, as there
static inline void servo_stop(void) {
  for (uint8_t number = 0; number < 14; number++)
    if (servo_slots[number].used && !servo_slots[number].own) servo_end(&servo_slots[number]);
}
