//# header servo360.h
// Servos that turn all round and tell their angle by the duty of a 910 Hz signal. Read from Simple-Libraries 1cc167c10,
// Learn/Simple Libraries/Motor/libservo360 (servo360.h, servo360.c and its files of one function each).
// The library's cog reads the angle every 20 ms and makes the pulse from it; here a job does, in frames of 20 ms, from the last of the
// signal's cycles, which pin-change interrupts time. Angles are 4,096 units a turn inside, speeds units a second, pulses 0.1 us.

//# constant S360_SPEED
//#   fidelity: exact
#define S360_SPEED 1

//# constant S360_POSITION
//#   fidelity: exact
#define S360_POSITION 2

//# constant S360_GOTO
//#   fidelity: exact
#define S360_GOTO 3

//# constant S360_MONITOR
//#   fidelity: exact
#define S360_MONITOR 4

//# constant S360_SETTING_KPV
//#   fidelity: exact
#define S360_SETTING_KPV 1

//# constant S360_SETTING_KIV
//#   fidelity: exact
#define S360_SETTING_KIV 2

//# constant S360_SETTING_KDV
//#   fidelity: exact
#define S360_SETTING_KDV 3

//# constant S360_SETTING_IV_MAX
//#   fidelity: exact
#define S360_SETTING_IV_MAX 4

//# constant S360_SETTING_KPA
//#   fidelity: exact
#define S360_SETTING_KPA 5

//# constant S360_SETTING_KIA
//#   fidelity: exact
#define S360_SETTING_KIA 6

//# constant S360_SETTING_KDA
//#   fidelity: exact
#define S360_SETTING_KDA 7

//# constant S360_SETTING_IA_MAX
//#   fidelity: exact
#define S360_SETTING_IA_MAX 8

//# constant S360_SETTING_VB_CCW
//#   fidelity: exact
#define S360_SETTING_VB_CCW 9

//# constant S360_SETTING_VB_CW
//#   fidelity: exact
#define S360_SETTING_VB_CW 10

//# constant S360_SETTING_VM_CCW
//#   fidelity: exact
#define S360_SETTING_VM_CCW 11

//# constant S360_SETTING_VM_CW
//#   fidelity: exact
#define S360_SETTING_VM_CW 12

//# constant S360_UNITS_ENCODER
//#   fidelity: exact
#define S360_UNITS_ENCODER 4096

//# helper Servo360
//#   needs: S360_POSITION hal/Uninterrupted hal/PinWatch servo.h/frames
//#   ram: 8
const int16_t turn360 = 4096;
const uint8_t still360 = 100;  // units/s: a wheel that stands, since edges are known to 0.4 us

struct Gains360 {  // in 1/1000
  int32_t proportional, integral, derivative, most;
};

inline int32_t thousandth(int32_t value) {  // within 0.01 %, without a division, which takes 40 us
  return ((value >> 16) * 4194 + (int32_t)((uint16_t)value * 4194UL >> 16)) >> 6;
}

struct Servo360 : PinWatch {
  uint8_t pin, signal;                              // signal 255: not wired, and the angle is taken to be as calculated
  bool enabled, feedback, approaching;
  uint8_t mode;
  int32_t units;                                    // of the program, each turn
  volatile uint16_t rise, fall, high[3], cycle[3];  // 1/16 us, of the signal's last cycles
  uint8_t place;                                    // of the next cycle
  volatile uint8_t cycles;                          // seen since the last frame, 255 at most
  int16_t theta;                                    // angle in the turn
  int32_t turns, offset, angle, angle_before;
  int32_t speed_asked, speed, speed_top, speed_step, speed_measured;
  int32_t angle_calculated, error, error_before, error_sum;
  int32_t set_point, off, off_before, off_sum, position_top;
  int32_t goal, angle_most, angle_least;
  Gains360 of_speed, of_position;
  int16_t slope[2], bend[2];                        // 0.1 us for each 1000 units/s and beyond neutral: counter-clockwise, clockwise
  int8_t couple;
  int32_t couple_scale;
  int32_t drive, out;                               // 0.1 us beyond neutral
  int8_t part;                                      // of a microsecond that earlier pulses were too short by, in 0.1 us

  int32_t inside(int32_t value) const { return value * turn360 / units; }
  int32_t outside(int32_t value) const { return value * units / turn360; }
  int32_t read(const int32_t &value) const {
    Uninterrupted now;
    return value;
  }
  void write(int32_t &place, int32_t value) {
    Uninterrupted now;
    place = value;
  }
  void forget_speed() { speed = error = error_before = error_sum = 0; }
  void forget_position() { off = off_before = off_sum = 0; }

  static uint16_t duty(uint16_t high, uint16_t cycle) {  // in 1/4348, as there: 13 bits of a quotient
    uint32_t rest = high * 4348UL, part = (uint32_t)cycle << 12;
    uint16_t quotient = 0;
    for (uint8_t bit = 13; bit; bit--, part >>= 1) {
      quotient <<= 1;
      if (rest < part) continue;
      rest -= part;
      quotient |= 1;
    }
    return quotient;
  }
  static int32_t in_frame(int32_t speed) {  // of 20 ms
    int16_t small = (int16_t)speed;
    return small == speed ? small / 50 : speed / 50;
  }
  bool measure() {  // the angle; false without a signal
    angle_before = angle;
    if (signal == 255) return true;
    uint16_t high_[3], cycle_[3];
    {
      Uninterrupted now;
      bool there = cycles > 2;
      cycles = 0;
      if (!there) return false;
      for (uint8_t each = 0; each < 3; each++) high_[each] = high[each], cycle_[each] = cycle[each];
    }
    bool below[3];  // the median counts: an interrupt may have come between
    for (uint8_t each = 0, next = 1; each < 3; each++, next = next == 2 ? 0 : next + 1)
      below[each] = (uint32_t)high_[each] * cycle_[next] < (uint32_t)high_[next] * cycle_[each];
    uint8_t median = below[0] == below[1] ? 1 : below[1] == below[2] ? 2 : 0;
    int16_t before = theta;
    theta = (turn360 - 1 - ((int16_t)duty(high_[median], cycle_[median]) - 129)) & (turn360 - 1);
    if (before > turn360 / 3 * 2 && theta < turn360 / 3) turns++;
    if (before < turn360 / 3 && theta > turn360 / 3 * 2) turns--;
    angle = turns * turn360 + theta - offset;
    return true;
  }
  int32_t pulse_of(int32_t ups) const {
    if (!ups) return 0;
    return thousandth(slope[ups < 0] * ups) + bend[ups < 0];
  }
  static int32_t limited(int32_t value, int32_t most) { return constrain(value, -most, most); }

  void hold() {
    forget_speed();
    off = set_point - angle;
    off_sum = limited(off_sum + off, of_position.most);
    int32_t ups = thousandth(of_position.proportional * off) + thousandth(of_position.integral * off_sum) +
                  thousandth(of_position.derivative * (off - off_before));
    off_before = off;
    ups = limited(ups, position_top);
    if (signal == 255) angle += in_frame(ups);
    out = pulse_of(ups);
  }
  void turn() {
    forget_position();
    if (speed != speed_asked) {
      if (abs(error) < turn360 / 2) speed += limited(speed_asked - speed, speed_step);
      drive = pulse_of(speed);
    }
    speed_measured = (angle - angle_before) * 50;
    if (frame_age < 18 || frame_age > 21) speed_measured = speed_measured * 20 / frame_age;  // a frame that had to wait, or the next one
    int32_t before = error, moved = in_frame(speed);
    angle_calculated += moved;
    if (signal == 255) {
      angle = angle_calculated;
      speed_measured = speed;
    }
    error = angle_calculated - angle;
    if (abs(error) >= turn360 / 2 && abs(error) > abs(before)) {  // too far behind: the calculated angle waits
      angle_calculated -= moved;
      error = before;
    }
    int32_t change = 0;
    if (abs(error) < turn360 / 2) {
      error_sum += error;
      change = error - error_before;
      error_before = error;
    }
    error_sum = limited(error_sum, of_speed.most);
    int32_t correction =
        thousandth(of_speed.proportional * error_before) + thousandth(of_speed.integral * error_sum) + thousandth(of_speed.derivative * change);
    out = drive + limited(correction, speed_top);
  }
  void go() {
    int32_t left = goal - angle, guard = speed_asked * abs(speed_asked) / (100 * speed_step) + 3 * speed_asked / 50;
    if (!approaching && left) {
      approaching = left < 0 ? left >= guard : left <= guard;
      speed_asked = approaching ? 0 : left < 0 ? -speed_top : speed_top;
    }
    turn();
    if (abs(left) < speed_step / (units * 50) || (approaching && abs(speed_measured) <= still360)) {
      speed_asked = speed = 0;
      set_point = goal;
      mode = S360_POSITION;
      approaching = false;
    }
  }
  int32_t lag() const { return speed > 0 ? error : speed < 0 ? -error : 0; }
  void slow_down(int32_t by) { out += out > 0 ? -by : out < 0 ? by : 0; }
};
static Servo360 *servos360[4];

//# helper feedback360_edge
//#   needs: Servo360 hal/PinWatch hal/edge_stamp
//#   fidelity: an edge is known to 1 us unless another interrupt runs; the median of three cycles counts
inline void feedback360_edge(PinWatch &watch) {  // short: the signal is high for 32 us at the least
  uint16_t now = edge_stamp();
  Servo360 &servo = static_cast<Servo360 &>(watch);
  if (!watch.level) {
    servo.fall = now;
    return;
  }
  uint16_t cycle = now - servo.rise;
  if (cycle > 800u * 16 && cycle < 1500u * 16) {
    uint8_t place = servo.place;
    servo.place = place == 2 ? 0 : place + 1;
    servo.high[place] = servo.fall - servo.rise;
    servo.cycle[place] = cycle;
    if (servo.cycles < 255) servo.cycles++;
  }
  servo.rise = now;
}

//# helper servo360_run
//#   needs: Servo360 S360_SPEED S360_POSITION S360_GOTO servo.h/servo_slot servo.h/ServoSlot servo.h/frames servo.h/servo_us
//#   ram: 1
inline void servo360_frame() {
  bool alive[4];
  for (uint8_t place = 0; place < 4; place++) {
    Servo360 *servo = servos360[place];
    alive[place] = servo && servo->measure();
    if (!alive[place] || !servo->feedback) continue;
    if (servo->mode == S360_POSITION) servo->hold();
    else if (servo->mode == S360_SPEED) servo->turn();
    else if (servo->mode == S360_GOTO) servo->go();
  }
  for (Servo360 *servo : servos360) {  // of two that are coupled, the one that lags less slows down
    if (!servo || servo->couple < 0 || !servo->feedback) continue;
    Servo360 *other = servos360[servo->couple];
    int32_t more = other->lag() - servo->lag(), by = thousandth(servo->couple_scale * abs(more));
    (more > 0 ? servo : other)->slow_down(min(by, 500));
  }
  for (uint8_t place = 0; place < 4; place++) {
    Servo360 *servo = servos360[place];
    ServoSlot *slot = servo ? servo_slot(servo->pin, false) : 0;
    if (!slot) continue;
    servo->out = Servo360::limited(servo->out, 2400);
    int16_t tenths = (int16_t)servo->out + servo->part, us = servo_us(servo->pin, 0, 1500) + tenths / 10;
    servo->part = tenths % 10;
    if (!alive[place] || !servo->enabled) slot->rest();
    else slot->send(us);
  }
}

inline void servo360_run() {
  static bool on = false;
  if (on) return;
  on = true;
  do_each_frame(servo360_frame);
  delay(500);
}

inline int8_t servo360_place(int32_t pin) {
  servo360_run();
  for (uint8_t place = 0; place < 4; place++)
    if (servos360[place] && (servos360[place]->pin == pin || (servos360[place]->signal == pin && pin != 255))) return place;
  return -1;
}

//# adapter servo360_connect
//#   for: int servo360_connect(int pinControl, int pinFeedback)
//#   kind: semantic
//#   needs: servo.h/servo_slot servo.h/ServoSlot hal/Uninterrupted Servo360 feedback360_edge servo360_run hal/watch_pin hal/Io simpletools.h/pulse_in servo.h/servo_us
//#   role: servo
//#   pin: pinControl digital out servo
//#   pin: pinFeedback digital in encoder
//#   fidelity: the place of the servo, or -8 without a signal, -4 and -5 for a pin in use, -7 for a fifth servo
//#   limit avr: the feedback pin needs a pin-change interrupt (all pins of an Uno)
//#   limit: where the feedback is not wired, the angle is taken to be as calculated
//#   stack: 100 78
//#   interrupt: PCINT0_vect 21
//#   interrupt: PCINT1_vect 38
//#   interrupt: PCINT2_vect 38
//#   interrupt: TIMER0_COMPA_vect 107 107
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_connect(int32_t pinControl, int32_t pinFeedback) {
  Io control(pinControl), signal(pinFeedback);
  if (signal.wired()) {
    int32_t width = pulse_in(pinFeedback, 1);
    if (width > 1200 || width < 25) return -8;
  }
  if (servo360_place(pinControl) >= 0) return -4;
  if (signal.wired() && servo360_place(pinFeedback) >= 0) return -5;
  int8_t place = 0;
  while (place < 4 && servos360[place]) place++;
  if (place == 4) return -7;
  Servo360 *servo = new Servo360();
  servo->pin = pinControl;
  servo->signal = signal.wired() ? pinFeedback : 255;
  servo->enabled = servo->feedback = true;
  servo->units = 360;
  servo->speed_top = servo->position_top = 2 * 4096L;
  servo->speed_step = 72L * 4096 / 360;
  servo->angle_most = 524287;
  servo->angle_least = -524287;
  servo->of_speed = {500, 0, 0, 0};
  servo->of_position = {12000, 600, 6000, 600};
  servo->slope[0] = servo->slope[1] = 180;
  servo->bend[0] = 200;
  servo->bend[1] = -200;
  servo->couple = -1;
  if (signal.wired()) {  // the first angle is the zero; no frame sees the servo yet, so all cycles are counted here
    watch_pin(*servo, pinFeedback, feedback360_edge);
    uint32_t begun = millis();
    while (servo->cycles < 3 && millis() - begun < 7);
    servo->measure();
  }
  servo->turns = 0;
  servo->offset = servo->theta;
  servo->angle = servo->angle_before = servo->angle_calculated = 0;
  {
    Uninterrupted now;
    servos360[place] = servo;
  }
  ServoSlot *slot = control.wired() ? servo_slot(pinControl, true) : 0;
  if (slot) {
    slot->own = true;
    slot->send(servo_us(pinControl, 0, 1500));
  }
  return place;
}

//# adapter servo360_speed
//#   for: int servo360_speed(int pin, int speed)
//#   kind: semantic
//#   needs: S360_SPEED S360_POSITION S360_GOTO hal/Uninterrupted Servo360 servo360_run
//#   pin: pin digital out servo
//#   fidelity: units a second, reached by the ramp in the background
//#   stack: 27 4
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_speed(int32_t pin, int32_t speed) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  speed = Servo360::limited(servo->inside(speed), servo->speed_top);
  if (speed == servo->speed_asked) return place;
  Uninterrupted now;
  if (servo->mode == S360_POSITION || servo->mode == S360_GOTO) servo->angle_calculated = servo->goal;
  servo->speed_asked = speed;
  servo->mode = S360_SPEED;
  servo->forget_position();
  return place;
}

//# adapter servo360_angle
//#   for: int servo360_angle(int pin, int position)
//#   kind: semantic
//#   needs: S360_POSITION hal/Uninterrupted Servo360 servo360_run
//#   pin: pin digital out servo
//#   fidelity: the angle is held in the background, by the same control as there
//#   stack: 25 2
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_angle(int32_t pin, int32_t position) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  position = constrain(position, servo->angle_least, servo->angle_most);
  Uninterrupted now;
  servo->set_point = servo->inside(position);
  servo->mode = S360_POSITION;
  servo->forget_speed();
  return place;
}

//# adapter servo360_goto
//#   for: int servo360_goto(int pin, int position)
//#   kind: semantic
//#   needs: S360_POSITION S360_GOTO hal/Uninterrupted Servo360 servo360_run
//#   pin: pin digital out servo
//#   fidelity: so many units from where it is to be, with the ramp and the top speed, in the background
//#   stack: 26 2
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_goto(int32_t pin, int32_t position) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  Uninterrupted now;
  int32_t from = servo->angle_calculated;
  if (servo->mode == S360_POSITION) from = servo->angle_calculated = servo->set_point;
  if (servo->mode == S360_GOTO) from = servo->goal;
  servo->goal = servo->inside(position) + from;
  if (servo->mode == S360_GOTO) servo->approaching = false;
  servo->mode = S360_GOTO;
  return place;
}

//# adapter servo360_set
//#   for: int servo360_set(int pinControl, int time)
//#   kind: oneToOne
//#   needs: Servo360 servo360_run servo.h/servo_us
//#   pin: pin digital out servo
//#   fidelity: a width in microseconds, which holds while the feedback is off; within 1,260 to 1,740 us, as there
//#   stack: 25 2
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_set(int32_t pin, int32_t time) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  servo->write(servo->out, (time - servo_us(servo->pin, 0, 1500)) * 10);
  return place;
}

//# adapter servo360_stop
//#   for: int servo360_stop(int pin)
//#   kind: oneToOne
//#   needs: servo360_run servo360_speed
//#   pin: pin digital out servo
//#   fidelity: exact; -1 for a pin without such a servo
//#   stack: 25 12
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_stop(int32_t pin) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  servo360_speed(pin, 0);
  return place;
}

//# adapter servo360_enable
//#   for: int servo360_enable(int pin, int state)
//#   kind: oneToOne
//#   needs: Servo360 servo360_run
//#   pin: pin digital out servo
//#   fidelity: exact: without it the servo gets no pulses
//#   stack: 12
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_enable(int32_t pin, int32_t state) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  servo->enabled = state;
  delay(1);
  return place;
}

//# adapter servo360_feedback
//#   for: int servo360_feedback(int pin, int state)
//#   kind: oneToOne
//#   needs: servo360_run Servo360 hal/Uninterrupted
//#   pin: pin digital out servo
//#   fidelity: off, servo360_set decides; on again, the angle there is the new zero, as there
//#   stack: 24 2
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_feedback(int32_t pin, int32_t state) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  Uninterrupted now;
  if (state == 1 && !servo->feedback) {
    servo->forget_speed();
    servo->forget_position();
    servo->turns = 0;
    servo->offset = servo->signal == 255 ? 0 : servo->theta;
    servo->angle = servo->angle_before = servo->angle_calculated = 0;
  }
  servo->feedback = state;
  return place;
}

//# adapter servo360_getAngle
//#   for: int servo360_getAngle(int pin)
//#   kind: oneToOne
//#   needs: servo360_run Servo360
//#   pin: pin digital out servo
//#   fidelity: within a degree; -1 for a pin without such a servo
//#   stack: 24 2
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_getAngle(int32_t pin) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  return servo->outside(servo->read(servo->angle));
}

//# adapter servo360_getAngle12Bit
//#   for: int servo360_getAngle12Bit(int pin)
//#   kind: oneToOne
//#   needs: servo360_run Servo360
//#   pin: pin digital out servo
//#   fidelity: within 12 of 4,096 units; -1 for a pin without such a servo
//#   stack: 18 2
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_getAngle12Bit(int32_t pin) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  return servo->read(servo->angle);
}

//# adapter servo360_getAngleFixedOrigin
//#   for: int servo360_getAngleFixedOrigin(int pin)
//#   kind: oneToOne
//#   needs: servo360_run Servo360
//#   pin: pin digital out servo
//#   fidelity: within 12 of 4,096 units; -1 for a pin without such a servo
//#   stack: 12 2
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_getAngleFixedOrigin(int32_t pin) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  return servo->theta;
}

//# adapter servo360_getAngleCalc
//#   for: int servo360_getAngleCalc(int pin)
//#   kind: oneToOne
//#   needs: servo360_run Servo360
//#   pin: pin digital out servo
//#   fidelity: exact; -1 for a pin without such a servo
//#   stack: 24 2
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_getAngleCalc(int32_t pin) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  return servo->outside(servo->read(servo->angle_calculated));
}

//# adapter servo360_getAngleOffset
//#   for: int servo360_getAngleOffset(int pin)
//#   kind: oneToOne
//#   needs: servo360_run Servo360
//#   pin: pin digital out servo
//#   fidelity: exact; -1 for a pin without such a servo
//#   stack: 24 2
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_getAngleOffset(int32_t pin) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  return servo->outside(servo->read(servo->offset));
}

//# adapter servo360_getSpeed
//#   for: int servo360_getSpeed(int pin)
//#   kind: oneToOne
//#   needs: servo360_run Servo360
//#   pin: pin digital out servo
//#   fidelity: from two angles 20 ms apart; an error of one unit of 4,096 is 50 of them a second
//#   limit: at rest up to seven units of 360 a second are measured, and up to 110 in two readings in a row where the clock's interrupt delays an edge by 6 us: compare with a threshold, not with 0
//#   stack: 24 2
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_getSpeed(int32_t pin) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  return servo->outside(servo->read(servo->speed_measured));
}

//# adapter servo360_getTurns
//#   for: int servo360_getTurns(int pin)
//#   kind: oneToOne
//#   needs: servo360_run Servo360
//#   pin: pin digital out servo
//#   fidelity: exact; -1 for a pin without such a servo
//#   stack: 18 2
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_getTurns(int32_t pin) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  return servo->read(servo->turns);
}

//# adapter servo360_getCsop
//#   for: int servo360_getCsop(int pin)
//#   kind: oneToOne
//#   needs: servo360_run Servo360
//#   pin: pin digital out servo
//#   fidelity: exact; -1 for a pin without such a servo
//#   stack: 12 2
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_getCsop(int32_t pin) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  return servo->mode;
}

//# adapter servo360_getMaxSpeed
//#   for: int servo360_getMaxSpeed(int pin)
//#   kind: oneToOne
//#   needs: servo360_run Servo360
//#   pin: pin digital out servo
//#   fidelity: exact; -1 for a pin without such a servo
//#   stack: 24 2
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_getMaxSpeed(int32_t pin) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  return servo->outside(servo->speed_top);
}

//# adapter servo360_getRampStep
//#   for: int servo360_getRampStep(int pin)
//#   kind: oneToOne
//#   needs: servo360_run Servo360
//#   pin: pin digital out servo
//#   fidelity: exact; -1 for a pin without such a servo
//#   stack: 12 2
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_getRampStep(int32_t pin) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  return servo->speed_step;
}

//# adapter servo360_getAcceleration
//#   for: int servo360_getAcceleration(int pin)
//#   kind: oneToOne
//#   needs: servo360_run Servo360
//#   pin: pin digital out servo
//#   fidelity: exact; -1 for a pin without such a servo
//#   stack: 24 2
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_getAcceleration(int32_t pin) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  return servo->speed_step * 50 * servo->units / turn360;
}

//# adapter servo360_getUnitsFullCircle
//#   for: int servo360_getUnitsFullCircle(int pin)
//#   kind: oneToOne
//#   needs: servo360_run Servo360
//#   pin: pin digital out servo
//#   fidelity: exact; -1 for a pin without such a servo
//#   stack: 12 2
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_getUnitsFullCircle(int32_t pin) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  return servo->units;
}

//# adapter servo360_getAngleCtrlSpeedMax
//#   for: int servo360_getAngleCtrlSpeedMax(int pin)
//#   kind: oneToOne
//#   needs: servo360_run Servo360
//#   pin: pin digital out servo
//#   fidelity: exact; -1 for a pin without such a servo
//#   stack: 24 2
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_getAngleCtrlSpeedMax(int32_t pin) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  return servo->outside(servo->position_top);
}

//# adapter servo360_setMaxSpeed
//#   for: int servo360_setMaxSpeed(int pin, int speed)
//#   kind: oneToOne
//#   needs: Servo360 servo360_run
//#   pin: pin digital out servo
//#   fidelity: exact: more than two turns a second is not taken, and 0 the answer
//#   stack: 25 4
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_setMaxSpeed(int32_t pin, int32_t speed) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  speed = servo->inside(speed);
  if (speed > 2 * 4096L) return 0;
  servo->write(servo->speed_top, speed);
  return place;
}

//# adapter servo360_setRampStep
//#   for: int servo360_setRampStep(int p, int stepSize)
//#   kind: oneToOne
//#   needs: Servo360 servo360_run
//#   pin: pin digital out servo
//#   fidelity: exact; -1 for a pin without such a servo
//#   stack: 12 2
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_setRampStep(int32_t pin, int32_t stepSize) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  servo->write(servo->speed_step, stepSize);
  return place;
}

//# adapter servo360_setAcceleration
//#   for: int servo360_setAcceleration(int pin, int unitsPerSecSquared)
//#   kind: oneToOne
//#   needs: Servo360 servo360_run
//#   pin: pin digital out servo
//#   fidelity: exact; -1 for a pin without such a servo
//#   stack: 25 4
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_setAcceleration(int32_t pin, int32_t unitsPerSecSquared) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  servo->write(servo->speed_step, unitsPerSecSquared * turn360 / (50 * servo->units));
  return place;
}

//# adapter servo360_setUnitsFullCircle
//#   for: int servo360_setUnitsFullCircle(int pin, int units)
//#   kind: oneToOne
//#   needs: Servo360 servo360_run
//#   pin: pin digital out servo
//#   fidelity: exact: once more than 360 is set it stays
//#   stack: 22 2
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_setUnitsFullCircle(int32_t pin, int32_t units) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  if (servo->units > 360) return -1;
  servo->write(servo->units, units);
  return place;
}

//# adapter servo360_setAngleCtrlSpeedMax
//#   for: int servo360_setAngleCtrlSpeedMax(int pin, int speed)
//#   kind: oneToOne
//#   needs: Servo360 servo360_run
//#   pin: pin digital out servo
//#   fidelity: exact: -2 for more than two turns a second
//#   stack: 25 4
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_setAngleCtrlSpeedMax(int32_t pin, int32_t speed) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  speed = servo->inside(speed);
  if (speed > 2 * 4096L) return -2;
  servo->write(servo->position_top, speed);
  return place;
}

//# adapter servo360_setAngleLimits
//#   for: int servo360_setAngleLimits(int pin, int ccwMax, int cwMax)
//#   kind: oneToOne
//#   needs: Servo360 servo360_run
//#   pin: pin digital out servo
//#   fidelity: exact; -1 for a pin without such a servo
//#   stack: 12 8
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_setAngleLimits(int32_t pin, int32_t ccwMax, int32_t cwMax) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  servo->angle_most = ccwMax;
  servo->angle_least = cwMax;
  return place;
}

//# adapter servo360_setAngleOffset
//#   for: int servo360_setAngleOffset(int pin, int angle)
//#   kind: oneToOne
//#   needs: Servo360 servo360_run
//#   pin: pin digital out servo
//#   fidelity: exact; -1 for a pin without such a servo
//#   stack: 25 4
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_setAngleOffset(int32_t pin, int32_t angle) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  servo->write(servo->offset, servo->inside(angle));
  return place;
}

//# adapter servo360_setAngleCalc
//#   for: int servo360_setAngleCalc(int pin, int angle)
//#   kind: oneToOne
//#   needs: Servo360 servo360_run
//#   pin: pin digital out servo
//#   fidelity: exact; -1 for a pin without such a servo
//#   stack: 25 4
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_setAngleCalc(int32_t pin, int32_t angle) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  servo->write(servo->angle_calculated, servo->inside(angle));
  return place;
}

//# adapter servo360_setTurns
//#   for: int servo360_setTurns(int pin, int turns)
//#   kind: oneToOne
//#   needs: S360_SPEED S360_POSITION S360_GOTO hal/Uninterrupted Servo360 servo360_run
//#   pin: pin digital out servo
//#   fidelity: so many turns more, as there; before the first order no target moves with them, as there
//#   limit: a servo that is set before its first order turns without correction, as there, and one that it is coupled to slows it down by up to 5 %
//#   stack: 22 2
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_setTurns(int32_t pin, int32_t turns) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  Uninterrupted now;
  int32_t more = turns * turn360;
  servo->turns += turns;
  servo->angle += more;
  servo->angle_before += more;
  bool holds = servo->mode == S360_POSITION, turns_ = servo->mode == S360_SPEED, goes = servo->mode == S360_GOTO;
  if (holds || turns_ || goes) servo->goal += more;
  if (holds || goes) servo->set_point += more;
  if (turns_ || goes) servo->angle_calculated += more;
  return place;
}

//# adapter servo360_setControlSys
//#   for: int servo360_setControlSys(int pin, int constant, int value)
//#   kind: oneToOne
//#   needs: S360_SETTING_KPV S360_SETTING_KIV S360_SETTING_KDV S360_SETTING_IV_MAX S360_SETTING_KPA S360_SETTING_KIA S360_SETTING_KDA S360_SETTING_IA_MAX hal/Uninterrupted Servo360 servo360_run
//#   pin: pin digital out servo
//#   fidelity: exact; -1 for a pin without such a servo
//#   stack: 28 8
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_setControlSys(int32_t pin, int32_t constant, int32_t value) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  Uninterrupted now;
  switch (constant) {
    case S360_SETTING_KPV: servo->of_speed.proportional = value; break;
    case S360_SETTING_KIV: servo->of_speed.integral = value; break;
    case S360_SETTING_KDV: servo->of_speed.derivative = value; break;
    case S360_SETTING_IV_MAX: servo->of_speed.most = value; break;
    case S360_SETTING_KPA: servo->of_position.proportional = value; break;
    case S360_SETTING_KIA: servo->of_position.integral = value; break;
    case S360_SETTING_KDA: servo->of_position.derivative = value; break;
    case S360_SETTING_IA_MAX: servo->of_position.most = value; break;
  }
  return place;
}

//# adapter servo360_setTransferFunction
//#   for: int servo360_setTransferFunction(int pin, int constant, int value)
//#   kind: oneToOne
//#   needs: S360_SETTING_VB_CCW S360_SETTING_VB_CW S360_SETTING_VM_CCW S360_SETTING_VM_CW hal/Uninterrupted Servo360 servo360_run
//#   pin: pin digital out servo
//#   fidelity: exact; -1 for a pin without such a servo
//#   stack: 30 8
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_setTransferFunction(int32_t pin, int32_t constant, int32_t value) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  Uninterrupted now;
  switch (constant) {
    case S360_SETTING_VM_CCW: servo->slope[0] = value; break;
    case S360_SETTING_VM_CW: servo->slope[1] = value; break;
    case S360_SETTING_VB_CCW: servo->bend[0] = value; break;
    case S360_SETTING_VB_CW: servo->bend[1] = value; break;
  }
  return place;
}

//# adapter servo360_couple
//#   for: int servo360_couple(int pinA, int pinB)
//#   kind: semantic
//#   needs: Servo360 servo360_run hal/Uninterrupted
//#   pin: pinA digital out servo
//#   pin: pinB digital out servo
//#   fidelity: the one that lags less is slowed down, as there
//#   stack: 23 12
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_couple(int32_t pinA, int32_t pinB) {
  int8_t a = servo360_place(pinA), b = servo360_place(pinB);
  if (a < 0) return -1;
  if (b < 0) return -2;
  if (a == b) return -3;
  Servo360 *first = servos360[min(a, b)];
  Uninterrupted now;
  first->couple = max(a, b);
  first->couple_scale = 2000;
  return max(a, b);
}

//# adapter servo360_setCoupleScale
//#   for: int servo360_setCoupleScale(int pinA, int pinB, int scale)
//#   kind: oneToOne
//#   needs: Servo360 servo360_run
//#   pin: pinA digital out servo
//#   pin: pinB digital out servo
//#   fidelity: that of the first one, as there
//#   stack: 29 12
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_setCoupleScale(int32_t pinA, int32_t pinB, int32_t scale) {
  int8_t a = servo360_place(pinA), b = servo360_place(pinB);
  if (a < 0) return -1;
  if (b < 0) return -2;
  servos360[a]->write(servos360[a]->couple_scale, scale);
  return a;
}

//# adapter servo360_getControlSys
//#   for: int servo360_getControlSys(int pin, int constant)
//#   kind: oneToOne
//#   needs: S360_SETTING_KPV S360_SETTING_KIV S360_SETTING_KDV S360_SETTING_IV_MAX S360_SETTING_KPA S360_SETTING_KIA S360_SETTING_KDA S360_SETTING_IA_MAX Servo360 servo360_run
//#   pin: pin digital out servo
//#   fidelity: exact; -1 for a pin without such a servo; 0 for any other setting, where the library returns anything
//#   stack: 26 2
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servo360_getControlSys(int32_t pin, int32_t constant) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  Servo360 *servo = servos360[place];
  switch (constant) {
    case S360_SETTING_KPV: return servo->of_speed.proportional;
    case S360_SETTING_KIV: return servo->of_speed.integral;
    case S360_SETTING_KDV: return servo->of_speed.derivative;
    case S360_SETTING_IV_MAX: return servo->of_speed.most;
    case S360_SETTING_KPA: return servo->of_position.proportional;
    case S360_SETTING_KIA: return servo->of_position.integral;
    case S360_SETTING_KDA: return servo->of_position.derivative;
    case S360_SETTING_IA_MAX: return servo->of_position.most;
  }
  return 0;
}

//# adapter servo360_getAngleLimits
//#   for: int servo360_getAngleLimits(int pin, int *ccwMax, int *cwMax)
//#   kind: oneToOne
//#   needs: Servo360 servo360_run
//#   pin: pin digital out servo
//#   fidelity: exact; -1 for a pin without such a servo
//#   stack: 12 2
//#   interrupt: TIMER0_COMPA_vect 114 114
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
template <class Int> inline int32_t servo360_getAngleLimits(int32_t pin, Int *ccwMax, Int *cwMax) {
  int8_t place = servo360_place(pin);
  if (place < 0) return -1;
  *ccwMax = servos360[place]->angle_most;
  *cwMax = servos360[place]->angle_least;
  return place;
}

//# adapter servo360_unitsAngleToEncoder
//#   for: int servo360_unitsAngleToEncoder(int value, int unitsRev)
//#   kind: oneToOne
//#   needs: S360_UNITS_ENCODER
//#   fidelity: exact, rounded towards 0
//#   stack: 0
inline int32_t servo360_unitsAngleToEncoder(int32_t value, int32_t unitsRev) {
  return value * S360_UNITS_ENCODER / unitsRev;
}

//# adapter servo360_unitsEncoderToAngle
//#   for: int servo360_unitsEncoderToAngle(int value, int unitsRev)
//#   kind: oneToOne
//#   needs: S360_UNITS_ENCODER
//#   symmetric: value unitsRev
//#   fidelity: exact, rounded towards 0
//#   stack: 0
inline int32_t servo360_unitsEncoderToAngle(int32_t value, int32_t unitsRev) {
  return value * unitsRev / S360_UNITS_ENCODER;
}

//# adapter servo360_monitorRun
//#   for: void servo360_monitorRun(void)
//#   kind: oneToOne
//#   fidelity: exact: the library as it is shipped leaves its monitor out, and does nothing
//#   stack: 0
inline void servo360_monitorRun() {}

//# adapter servo360_monitorEnd
//#   for: void servo360_monitorEnd(void)
//#   kind: oneToOne
//#   fidelity: exact: the library as it is shipped leaves its monitor out, and does nothing
//#   stack: 0
inline void servo360_monitorEnd() {}
