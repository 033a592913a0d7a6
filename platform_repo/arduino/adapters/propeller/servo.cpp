//# header servo.h
// Servos with pulses in the background. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Motor/libservo (servo.h, servo.c).
// The library's cog makes a pulse for each of 14 servos every 20 ms; here Servo.h does, with its timer. What else a cog did every frame
// is a job of that timer's other compare interrupt, 2 ms before the pulses, so that each pulse has the width of its own frame. Jobs let
// other interrupts in, so that pulses keep their width. Of stack the interrupt takes 23 bytes and a frame job (of servo360.h 77, of
// abdrive.h up to 54), and that of the samples, which comes meanwhile, 23 and a sample job (of encoders 23).

//# helper background
//#   needs: hal/Uninterrupted hal/periods
//#   fidelity: sample jobs every 1,024 us with interrupts on
//#   ram: 6
static void (*sample_jobs[2])();
static void (*each_period)();  // of 1,024 us

inline void period_comes() {
  for (auto job : sample_jobs)
    if (job) job();
  if (each_period) each_period();
}

template <uint8_t places> inline void add_job(void (*(&jobs)[places])(), void (*job)()) {
  for (auto &place : jobs) {
    if (place == job) return;
    if (place) continue;
    place = job;
    return;
  }
}

inline void sample_in_background(void (*job)()) {
  Uninterrupted now;
  add_job(sample_jobs, job);
  count_periods();
}

//# helper frames
//#   needs: background hal/Uninterrupted hal/periods hal/frame_clock simpletools.h/TimedInput
//#   fidelity: frame jobs every 20 ms with interrupts on; they wait while an input is timed, and are made up for when it ends
//#   ram: 9
static void (*frame_jobs[3])();
static volatile uint8_t frames_owed;  // that have waited
static volatile uint8_t frame_age;    // periods of 1,024 us since the frame jobs began last

inline void do_frame_jobs() {
  static volatile bool under_way = false;
  {
    Uninterrupted now;
    if (!frames_owed || frame_age <= 7 || under_way) return;
    under_way = true;
    frames_owed--;
  }
  for (auto job : frame_jobs)
    if (job) job();
  frame_age = 0;
  under_way = false;
}

inline void do_owed_frames() {  // all of them, as what comes next may make them wait again
  for (uint8_t owed = frames_owed; owed; owed--) {
    frame_age = 8;
    do_frame_jobs();
  }
}

inline void frame_period() {
  if (frame_age < 255) frame_age++;
  if (frames_wait) frames_wait--;
  else do_frame_jobs();
}

inline void frame_is_owed() {
  if (frames_owed < 3) frames_owed++;
}

inline void frame_comes() {
  if (!frames_wait) do_frame_jobs();
}

inline void do_each_frame(void (*job)()) {
  Uninterrupted now;
  add_job(frame_jobs, job);
  frames_due = do_owed_frames;
  each_period = frame_period;
  count_periods();
  count_frames();
}

//# helper frames
//#   drawn: motor-driver
//#   needs: background hal/Uninterrupted hal/periods simpletools.h/TimedInput
//#   fidelity: frame jobs every 20 ms, up to 1 ms late; no timer is taken for them, so that motors have PWM on all its pins
//#   ram: 18
static void (*frame_jobs[3])();
static uint8_t frames_owed;  // that have waited

inline void do_frame_jobs() {
  static volatile bool under_way = false;
  {
    Uninterrupted now;
    if (!frames_owed || under_way) return;
    under_way = true;
    frames_owed--;
  }
  for (auto job : frame_jobs)
    if (job) job();
  under_way = false;
}

inline void do_owed_frames() {
  for (uint8_t owed = frames_owed; owed; owed--) do_frame_jobs();
}

inline void frame_period() {
  static uint16_t due = (uint16_t)micros();
  if ((int16_t)((uint16_t)micros() - due) >= 0) {
    due += 20000;
    if (frames_owed < 3) frames_owed++;
  }
  if (frames_wait) frames_wait--;
  else do_frame_jobs();
}

inline void do_each_frame(void (*job)()) {
  Uninterrupted now;
  add_job(frame_jobs, job);
  frames_due = do_owed_frames;
  each_period = frame_period;
  count_periods();
}

//# helper motors
//#   drawn: motor-driver
//#   needs: hal/Io
//#   fidelity: a motor's share of full power is that of 200 us which a servo's pulse is longer than 1,500 us, backwards for a shorter
//#   fidelity: one; at a stand, and without pulses, all inputs are low and the motor coasts
//#   limit: 128 ticks/s are full power of the motors, whose speed depends on supply and load; measure it for [servos] of robosmi.toml
//#   ram: 10
struct Motor {
  const MotorPins *pins;
  int16_t share;  // in 1/255 of full power, backwards if negative
  bool on;

  explicit operator bool() const { return pins; }
  void find(uint8_t pin) {
    pins = 0;
    for (const auto &each : motor_pins)
      if (each.port == pin) pins = &each;
  }
  void turn(int16_t asked) {
    if (on && asked == share) return;
    share = asked;
    uint8_t ahead = asked < 0 ? pins->second : pins->first, behind = asked < 0 ? pins->first : pins->second;
    if (!on) output(pins->awake, true);
    on = true;
    if (pins->enable == NO_PIN) {
      analogWrite(behind, 0);
      analogWrite(ahead, abs(asked));
      return;
    }
    output(behind, false);
    output(ahead, asked != 0);
    analogWrite(pins->enable, abs(asked));
  }
  void send(int16_t us) { turn((constrain(us, 1300, 1700) - 1500) * 51 / 40); }
  void rest() {
    turn(0);
    on = false;
  }
  void release() {
    rest();
    const uint8_t inputs[] = {pins->enable, pins->first, pins->second};
    for (uint8_t input : inputs) Io(input).drive(false);
  }
  static void output(uint8_t pin, bool high) {
    Io io(pin);
    io.set(high);
    io.drive_for_library();
  }
};

//# helper ServoSlot
//#   needs: hal/Io hal/ServoPin
//#   fidelity: Servo.h makes pulses for at most 12 servos with one timer, the library for 14 with a cog
//#   ram: 132
struct ServoSlot : ServoPin {
  bool used, own;              // own: of a drive, which servo_stop and the like leave alone
  int16_t asked, sent, step;   // microseconds; step: at most so many more or less each frame

  bool take() {  // the place for the servo at its pin
    if (!servo) servo = new Servo;
    return true;
  }
  bool runs() const { return servo->attached(); }
  void send(int16_t us) {
    if (runs()) servo->writeMicroseconds(us);
    else start(us);
  }
  void release() {
    if (runs()) rest();
    Io(pin).drive(false);
  }
};
static ServoSlot servo_slots[servo_places];

//# helper ServoSlot
//#   drawn: motor-driver
//#   needs: motors
//#   fidelity: as many motors as the drivers have channels wired to the board; nothing happens at other pins
//#   ram: 28
struct ServoSlot {
  uint8_t pin;
  bool used, own;              // own: of a drive, which servo_stop and the like leave alone
  int16_t asked, sent, step;   // microseconds; step: at most so many more or less each frame
  Motor motor;

  bool take() {  // the place for the motor at its pin
    motor.find(pin);
    return (bool)motor;
  }
  bool runs() const { return motor.on; }
  void send(int16_t us) { motor.send(us); }
  void rest() { motor.rest(); }
  void release() { motor.release(); }
};
static ServoSlot servo_slots[sizeof motor_pins / sizeof *motor_pins];

//# helper ServoSlot
//#   drawn: motor-driver servo
//#   needs: hal/Io hal/ServoPin motors
//#   fidelity: servos as without motors, but their ramps move up to 1 ms beside their pulses
//#   limit avr: no PWM for motors on pins 9 and 10 of an Uno while a servo gets pulses
//#   ram: 192
struct ServoSlot : ServoPin {
  bool used, own;              // own: of a drive, which servo_stop and the like leave alone
  int16_t asked, sent, step;   // microseconds; step: at most so many more or less each frame
  Motor motor;

  bool take() {  // the place for the motor or the servo at its pin
    motor.find(pin);
    if (!motor && !servo) servo = new Servo;
    return true;
  }
  bool runs() const { return motor ? motor.on : servo->attached(); }
  void send(int16_t us) {
    if (motor) motor.send(us);
    else if (runs()) servo->writeMicroseconds(us);
    else start(us);
  }
  void rest() {
    if (motor) motor.rest();
    else ServoPin::rest();
  }
  void release() {
    if (motor) return motor.release();
    if (runs()) rest();
    Io(pin).drive(false);
  }
};
static ServoSlot servo_slots[servo_places];

//# helper servo_slot
//#   needs: ServoSlot
inline ServoSlot *servo_slot(int32_t pin, bool make) {
  ServoSlot *free = 0;
  for (auto &slot : servo_slots) {
    if (slot.used && slot.pin == pin) return &slot;
    if (!slot.used && !free) free = &slot;
  }
  if (!make || !free) return 0;
  free->pin = pin;
  if (!free->take()) return 0;
  free->own = false;
  free->step = 2000;
  free->used = true;
  return free;
}

//# helper servo_us
//#   fidelity: by the table of the servo at the pin, straight between its points; without one, moved by its neutral pulse
inline int16_t servo_us(uint8_t pin, int16_t speed, int16_t otherwise) {  // otherwise: microseconds where nobody has measured
#ifdef SERVO_TRIMS
  for (const auto &trim : servo_trims) {
    if (trim.pin != pin) continue;
    if (!trim.points) return otherwise - 1500 + trim.neutral;
    const int16_t *at = trim.speeds;
    if (speed <= at[0]) return at[1];
    for (uint8_t left = trim.points - 1; left; left--, at += 2)
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
//#   kind: oneToMany
//#   needs: servo_slot ServoSlot hal/Io hal/Uninterrupted
//#   pin: pin digital out servo
//#   fidelity: widths within 1 us; returns the pin (the target's) at the first call, 1 later, -3 without a free place, as there; 0 us ends the pulses
//#   limit avr: 12 servos at a time instead of 14, but 14 on a Mega; no PWM on pins 9 and 10 of an Uno, or 44 to 46 of a Mega
//#   limit rp2040: 8 servos at a time instead of 14
//#   limit other: 8 servos at a time instead of 14
//#   limit avr: widths from 40 to 2,900 us
//#   limit rp2040: widths from 200 to 2,900 us
//#   range avr: time 40..2900 or 0: the pulse is made 40 or 2,900 us long
//#   range rp2040: time 200..2900 or 0: the pulse is made 200 or 2,900 us long
//#   stack: 38 22
//#   interrupt: TIMER1_COMPA_vect 21
inline int32_t servo_set(int32_t pin, int32_t time) {
  if (!Io(pin).wired()) return 0;
  ServoSlot *slot = servo_slot(pin, false);
  int32_t known = slot ? 1 : pin;
  if (!time) {
    if (slot) {
      slot->release();
      slot->used = false;
    }
    return known;
  }
  if (!slot) {
    slot = servo_slot(pin, true);
    if (!slot) return -3;
    slot->sent = time;
  }
  {
    Uninterrupted now;
    slot->asked = time;
  }
  for (auto &each : servo_slots)  // those that servo_stop has ended go on, as they do when the library's cog starts again
    if (each.used && !each.own && !each.runs()) each.send(each.sent);
  if (slot->step >= 2000) slot->send(slot->sent = time);
  return known;
}

//# adapter servo_angle
//#   for: int servo_angle(int pin, int degreeTenths)
//#   kind: oneToOne
//#   needs: servo_set
//#   pin: pin digital out servo
//#   fidelity: 500 us and one more for each tenth of a degree, as there
//#   range avr: degreeTenths -460..2400 or -500: the pulse is made 40 or 2,900 us long
//#   range rp2040: degreeTenths -300..2400 or -500: the pulse is made 200 or 2,900 us long
//#   stack: 38 22
//#   interrupt: TIMER1_COMPA_vect 21
inline int32_t servo_angle(int32_t pin, int32_t degreeTenths) {
  return servo_set(pin, degreeTenths + 500);
}

//# adapter servo_speed
//#   for: int servo_speed(int pin, int speed)
//#   kind: oneToOne
//#   needs: servo_set servo_us
//#   pin: pin digital out servo
//#   fidelity: 1,500 us and one more for each unit, as there; positive is counter-clockwise
//#   range avr: speed -1460..1400 or -1500: the pulse is made 40 or 2,900 us long
//#   range rp2040: speed -1300..1400 or -1500: the pulse is made 200 or 2,900 us long
//#   stack: 38 22
//#   interrupt: TIMER1_COMPA_vect 21
inline int32_t servo_speed(int32_t pin, int32_t speed) {
  int32_t us = speed + 1500;
  return servo_set(pin, us > 0 && us < 3000 ? servo_us(pin, speed, us) : us);
}

//# adapter servo_get
//#   for: int servo_get(int pin)
//#   kind: oneToOne
//#   needs: servo_slot ServoSlot hal/Uninterrupted
//#   pin: pin digital out servo
//#   fidelity: the width last sent in microseconds, on the way of a ramp too; -4 for a pin without a servo
//#   stack: 4 0
//#   interrupt: TIMER1_COMPA_vect 21
inline int32_t servo_get(int32_t pin) {
  ServoSlot *slot = servo_slot(pin, false);
  if (!slot) return -4;
  Uninterrupted now;
  return slot->sent;
}

//# adapter servo_setramp
//#   for: int servo_setramp(int pin, int stepSize)
//#   kind: semantic
//#   needs: servo_slot ServoSlot frames
//#   pin: pin digital out servo
//#   fidelity: at most so many microseconds more or less every 20 ms, in the background; -4 for a pin without a servo
//#   stack: 2 0
//#   interrupt: TIMER0_COMPA_vect 46 46
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline void servo_ramps() {
  for (auto &slot : servo_slots) {
    if (!slot.used || slot.own || !slot.runs()) continue;
    int16_t difference = slot.asked - slot.sent;
    if (!difference) continue;
    slot.sent += constrain(difference, -slot.step, slot.step);
    slot.send(slot.sent);
  }
}

inline int32_t servo_setramp(int32_t pin, int32_t stepSize) {
  ServoSlot *slot = servo_slot(pin, false);
  if (!slot) return -4;
  slot->step = stepSize;
  do_each_frame(servo_ramps);
  return pin;
}

//# adapter servo_disable
//#   for: int servo_disable(int pin)
//#   kind: oneToOne
//#   needs: servo_set
//#   pin: pin digital out servo
//#   fidelity: as there: the pin becomes an input; a pulse under way is ended first, for which it waits up to 3 ms
//#   stack: 22 14
//#   interrupt: TIMER1_COMPA_vect 21
inline int32_t servo_disable(int32_t pin) {
  return servo_set(pin, 0);
}

//# adapter servo_stop
//#   for: void servo_stop(void)
//#   kind: oneToMany
//#   needs: ServoSlot
//#   fidelity: all pulses end and the pins become inputs; they go on with the next call of servo_set and its like, as there
//#   stack: 24 14
//#   interrupt: TIMER1_COMPA_vect 21
inline void servo_stop() {
  for (auto &slot : servo_slots)
    if (slot.used && !slot.own) slot.release();
}
