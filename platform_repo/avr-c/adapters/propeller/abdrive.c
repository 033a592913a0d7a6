//# header abdrive.h
// The drive of the ActivityBot in C: two continuous servos with encoders of 64 ticks a turn. Read from Simple-Libraries 1cc167c10,
// Learn/Simple Libraries/Robotics/ActivityBot/libabdrive (abdrive.c and .h, speed.c, goto.c, ramp.c, getticks.c, gotoMode.c,
// gotoStatus.c, setAcceleration.c, setMaxSpeed.c, setRampStep.c, servoPins.c).
// The library's cog works in frames of 20 ms. So does the job below: a ramp of 12 ticks/s each frame, the wheel with the smaller change
// scaled, five frames of rest whenever a wheel comes to a stand, and no pulses at a stand.
//# task drive_displayInterpolation the drive here has no calibration of the source's EEPROM to show: measure the servos, and put their table into robosmi.toml, [servos]
//# task drive_calibrationResults the drive here has no calibration of the source's EEPROM to show: measure the servos, and put their table into robosmi.toml, [servos]
//# task drive_setErrorLimit the drive here runs in open loop, where encoders correct nothing that could be limited: take the call out

//# constant FOR_SPEED
//#   fidelity: exact
#define FOR_SPEED 0

//# constant FOR_GOTO
//#   fidelity: exact
#define FOR_GOTO 1

//# constant SIDE_LEFT
//#   fidelity: exact
#define SIDE_LEFT 0

//# constant SIDE_RIGHT
//#   fidelity: exact
#define SIDE_RIGHT 1

//# constant SIDE_BOTH
//#   fidelity: exact
#define SIDE_BOTH 2

//# constant OFF
//#   fidelity: exact
#define OFF 0

//# constant ON
//#   fidelity: exact
#define ON 1

//# helper drive_top
//#   fidelity: ticks/s, of drive_speed
//#   ram: 2
static volatile int16_t drive_top = 128;

//# helper drive_step
//#   fidelity: ticks/s each frame, of drive_speed
//#   ram: 2
static int16_t drive_step = 12;

//# helper drive_goto_step
//#   fidelity: ticks/s each frame, of drive_goto
//#   ram: 2
static int16_t drive_goto_step = 4;

//# helper wheels
//#   needs: simpletools.h/Io
//#   include: <avr/interrupt.h> <stdlib.h>
//#   ram: 70
typedef struct {
  volatile int16_t speed, target;     // ticks/s
  int16_t step;                       // ticks/s each frame
  uint8_t finer, finer_sum;           // what whole numbers lose of the step, in 1/50, carried over frames
  uint8_t top_finer, top_finer_sum;   // the same of the top speed
  volatile uint8_t rest;              // frames left at a stand
  volatile uint8_t going;             // drive_goto: 0 there, 1 on the way, 2 coming to a stand, 3 the last ticks at 4 ticks/s
  int16_t top, guard;                 // drive_goto: ticks/s, and how many ticks before the end it stops
  volatile int32_t goal, ticks;       // encoder ticks
  volatile int32_t way50;             // ticks as calculated from the speed, in 1/50
  volatile int8_t sense;              // sign of the last motion
  uint8_t level;                      // encoder: bit 0 the level counted last, bit 1 the level seen last
  uint8_t pin;
  Io input;                           // of the encoder
} Wheel;
static Wheel wheels[2] __attribute__((unused));

static inline int16_t whole_16(const volatile int16_t *value) {  // not torn by an interrupt
  uint8_t old = SREG;
  cli();
  int16_t now = *value;
  SREG = old;
  return now;
}

static inline int32_t whole_32(const volatile int32_t *value) {
  uint8_t old = SREG;
  cli();
  int32_t now = *value;
  SREG = old;
  return now;
}

static inline int16_t within(int16_t value, int16_t most) {
  return value > most ? most : value < -most ? -most : value;
}

static inline void change_by(Wheel *wheel, int16_t most, int32_t part, int32_t whole) {  // the step: the part of `most` that its change is of the greater one
  wheel->finer_sum = 0;
  wheel->step = part < whole ? most * part / whole : most;
  wheel->finer = part < whole ? most * part % whole * 50 / whole : 0;
}

static inline uint8_t drive_carried(uint8_t *sum, uint8_t part) {  // 1 when fiftieths have become a whole
  *sum += part;
  if (*sum < 50) return 0;
  *sum -= 50;
  return 1;
}

//# helper drive_counts
//#   ram: 2
static void (*drive_counts)(void);  // what begins to count encoder ticks when the drive starts, where the program asks for them

//# helper drive_pins
//#   port: left_servo = abdrive.left_servo 12 digital out servo
//#   port: right_servo = abdrive.right_servo 13 digital out servo
//#   ram: 2
static uint8_t drive_pins[2];

__attribute__((constructor, used)) static void drive_usual_pins(void) {
  drive_pins[0] = left_servo;
  drive_pins[1] = right_servo;
}

//# helper drive_us
//#   needs: wheels servo.h/servo_us
//#   fidelity: open loop: 128 ticks/s are taken as 200 us beyond neutral. Real servos reach their speed earlier: measure a table, and
//#   fidelity: put it into robosmi.toml, [servos]
//#   limit: open loop: encoders do not correct the speed, and the calibration of the source robot does not carry over (see drive_us)
static inline int16_t drive_us(const Wheel *wheel, uint8_t side) {  // the pulse for the wheel's speed
  int32_t by16 = (int32_t)wheel->speed * 25;
  int16_t beyond = (by16 < 0 ? by16 + 15 : by16) >> 4;
  return servo_us(wheel->pin, wheel->speed, side ? 1500 - beyond : 1500 + beyond);
}

//# helper drive_frame
//#   needs: wheels drive_top drive_us servo.h/servo_slots servo.h/servo_send
//#   ram: 3
static void (*drive_goto_frame)(Wheel *wheel);
static volatile uint8_t drive_frames;

static void drive_frame(void) {
  for (uint8_t side = 0; side < 2; side++) {
    Wheel *wheel = &wheels[side];
    int16_t before = wheel->speed;
    uint8_t more = drive_carried(&wheel->finer_sum, wheel->finer);
    if (wheel->going && drive_goto_frame) drive_goto_frame(wheel);
    wheel->target = within(wheel->target, drive_top);
    if (!wheel->rest && wheel->going != 3) {
      if (wheel->target > wheel->speed + wheel->step) wheel->speed += wheel->step + more;
      else if (wheel->target < wheel->speed - wheel->step) wheel->speed -= wheel->step + more;
      else wheel->speed = wheel->target;
    }
    int16_t speed = wheel->speed;
    if (!speed && before) wheel->rest = 5;
    if (speed) wheel->sense = speed > 0 ? 1 : -1;
    wheel->way50 += speed;
    volatile ServoSlot *slot = servo_slot(wheel->pin, false);
    if (slot && speed) servo_send(slot, drive_us(wheel, side));
    else if (slot && drive_frames > 0 && slot->on) servo_rest(slot);
    if (!speed && wheel->rest) wheel->rest--;
  }
  drive_frames = drive_frames == 255 ? 128 : drive_frames + 1;
}

static inline void drive_wait_frames_from(uint8_t count, uint8_t last) {
  while (count) {
    if (drive_frames == last) continue;
    last = drive_frames;
    count--;
  }
}

static inline void drive_wait_frames(uint8_t count) { drive_wait_frames_from(count, drive_frames); }

static inline void drive_wait_rest(void) {
  while (wheels[0].rest || wheels[1].rest) {}
}

//# helper drive_start
//#   needs: drive_counts drive_frame drive_pins wheels servo.h/servo_slots servo.h/servo_send servo.h/frames servo.h/servo_us simpletools.h/Io
//#   ram: 1
static bool drive_on;

static inline void drive_start(void) {  // as long as the library takes for the start of its cog
  if (drive_on) return;
  drive_on = true;
  for (uint8_t side = 0; side < 2; side++) {
    wheels[side].pin = drive_pins[side];
    volatile ServoSlot *slot = io_at(drive_pins[side]).mask ? servo_slot(drive_pins[side], true) : 0;
    if (!slot) continue;
    slot->own = true;
    servo_send(slot, servo_us(drive_pins[side], 0, 1500));
  }
  if (drive_counts) drive_counts();
  do_each_frame(drive_frame);
  drive_wait_frames(7);
}

//# helper drive_encoders
//#   needs: drive_counts wheels simpletools.h/Io servo.h/background
//#   port: left_encoder = abdrive.left_encoder 14 digital in encoder
//#   port: right_encoder = abdrive.right_encoder 15 digital in encoder
//#   fidelity: a change of level is a tick when it is seen twice, as there; levels are read 976 times a second, there 800 times
//#   ram: 2
static uint8_t drive_encoder_pins[2];

static void drive_sample(void) {
  for (uint8_t side = 0; side < 2; side++) {
    Wheel *wheel = &wheels[side];
    if (!wheel->input.mask) continue;
    uint8_t now = io_high(wheel->input), seen = wheel->level >> 1;
    if (now == seen && now != (wheel->level & 1)) {
      wheel->ticks += wheel->sense;
      wheel->level ^= 1;
    }
    wheel->level = (wheel->level & 1) | now << 1;
  }
}

static void drive_watch_encoders(void) {
  for (uint8_t side = 0; side < 2; side++) {
    Wheel *wheel = &wheels[side];
    wheel->input = io_at(drive_encoder_pins[side]);
    io_drive(wheel->input, false);
    wheel->level = io_high(wheel->input) * 3;
    wheel->sense = wheel->sense ? wheel->sense : 1;
  }
  sample_job = drive_sample;
  count_periods();
}

__attribute__((constructor, used)) static void drive_counts_from_its_start(void) {
  drive_encoder_pins[0] = left_encoder;
  drive_encoder_pins[1] = right_encoder;
  drive_counts = drive_watch_encoders;
}

//# adapter drive_speed
//#   for: void drive_speed(int left, int right)
//#   kind: semantic
//#   needs: drive_step wheels drive_frame drive_start simpletools.h/timed_input
//#   role: servo
//#   fidelity: acts on a change only, and returns after 6 frames (100 to 120 ms), later when a wheel rests, while the ramp goes on; the
//#   fidelity: first call starts the drive, which takes 140 ms
//#   ram: 4
static int16_t drive_last[2];

static void drive_head_for(int16_t left, int16_t right) {
  int16_t to[2] = {left, right};
  frames_due();  // those before this call
  uint8_t old = SREG;
  cli();
  uint8_t last = drive_frames;  // with the next one the change begins
  int16_t change[2] = {abs(left - wheels[0].speed), abs(right - wheels[1].speed)};
  for (uint8_t side = 0; side < 2; side++) {
    wheels[side].going = 0;
    wheels[side].target = to[side];
    change_by(&wheels[side], drive_step, change[side], change[!side]);
  }
  SREG = old;
  if (wheels[0].rest || wheels[1].rest) {
    drive_wait_rest();
    last = drive_frames;
  }
  drive_wait_frames_from(6, last);
  drive_wait_rest();
}

static inline void drive_speed(int32_t left, int32_t right) {
  drive_start();
  if (left != drive_last[0] || right != drive_last[1]) drive_head_for(left, right);
  for (uint8_t side = 0; side < 2; side++) drive_last[side] = wheels[side].target;
}

//# adapter drive_rampStep
//#   for: void drive_rampStep(int left, int right)
//#   kind: oneToOne
//#   needs: drive_speed
//#   role: servo
//#   fidelity: the same as drive_speed, as there since version 2
static inline void drive_rampStep(int32_t left, int32_t right) {
  drive_speed(left, right);
}

//# adapter drive_ramp
//#   for: void drive_ramp(int left, int right)
//#   kind: oneToMany
//#   needs: drive_speed wheels propeller.h/clock_wait
//#   role: servo
//#   fidelity: returns when one of the wheels is within 4 ticks/s, as there
//#   limit: two speeds beyond the limit of drive_setMaxSpeed are never reached: it returns at the limit, where the library waits for ever
static inline bool drive_is_near(uint8_t side, int32_t asked) {
  int16_t speed = whole_16(&wheels[side].speed);
  return speed > asked - 4 && speed < asked + 4;
}

static inline bool drive_is_ramping(void) {
  for (uint8_t side = 0; side < 2; side++)
    if (whole_16(&wheels[side].speed) != whole_16(&wheels[side].target)) return true;
  return false;
}

static inline void drive_ramp(int32_t left, int32_t right) {
  drive_speed(left, right);
  while (!drive_is_near(0, left) && !drive_is_near(1, right) && drive_is_ramping()) clock_wait(20);
}

//# adapter drive_getTicks
//#   for: void drive_getTicks(int *left, int *right)
//#   kind: semantic
//#   needs: drive_encoders wheels
//#   role: encoder
//#   fidelity: ticks since the first call that drives, and 0 before it, counted up or down by the sense in which the wheel was driven last,
//#   fidelity: as there
#define drive_getTicks(left, right) \
  (*(left) = whole_32(&wheels[0].ticks), *(right) = whole_32(&wheels[1].ticks), (void)0)

//# adapter drive_getTicksCalc
//#   for: void drive_getTicksCalc(int *left, int *right)
//#   kind: semantic
//#   needs: wheels
//#   fidelity: ticks as the speeds make them
//#   limit: encoders do not hold them within the error limit
#define drive_getTicksCalc(left, right) \
  (*(left) = whole_32(&wheels[0].way50) / 50, *(right) = whole_32(&wheels[1].way50) / 50, (void)0)

//# helper drive_going
//#   needs: wheels
//#   fidelity: a wheel accelerates, keeps its top speed until the rest of the way is what it needs to stop, stops, and makes the ticks still
//#   fidelity: missing at 4 ticks/s: as there a few of a wheel whose way is the shorter one, and most of a short way after a long one
//#   ram: 7
static volatile uint16_t drive_still;  // frames since the last tick
static bool drive_goto_waits = true;
static int32_t drive_ticks_before;

static inline void drive_go_on(Wheel *wheel) {
  int32_t now = whole_32(&wheels[0].ticks) + whole_32(&wheels[1].ticks);
  if (now != drive_ticks_before) drive_still = 0;
  else if (drive_still < 65535) drive_still++;
  drive_ticks_before = now;
  int32_t left = wheel->goal - whole_32(&wheel->ticks);
  if (drive_still > 1000) {  // twice a frame at most: ten seconds without a tick
    wheel->going = 0;
    wheel->target = wheel->speed = 0;
    return;
  }
  uint8_t more = drive_carried(&wheel->top_finer_sum, wheel->top_finer);
  if (wheel->going == 1) {  // as there: divided by the whole steps alone, by none of them -1, and at a stand what it was before
    if (wheel->speed) wheel->guard = wheel->step ? (int32_t)wheel->speed * wheel->speed / (100 * wheel->step) : 1;
    if (labs(left) > wheel->guard + more) {
      wheel->target = left > 0 ? wheel->top + more : -wheel->top - more;
    } else {
      wheel->target = 0;
      wheel->going = 2;
    }
  }
  if (!wheel->rest && (wheel->going == 3 || (wheel->going == 2 && !wheel->speed))) {
    wheel->going = left ? 3 : 0;
    wheel->speed = left > 0 ? 4 : left < 0 ? -4 : 0;
  }
}

static inline bool drive_on_the_way(void) {
  return wheels[0].going || wheels[1].going || wheels[0].rest || wheels[1].rest;
}

//# adapter drive_goto
//#   for: void drive_goto(int distLeft, int distRight)
//#   kind: semantic
//#   needs: drive_goto_step drive_top wheels drive_frame drive_start drive_encoders drive_speed drive_going propeller.h/clock_wait simpletools.h/timed_input
//#   role: encoder
//#   fidelity: stops, drives both wheels so many ticks in the same time, and returns when they stand
//#   limit: gives up ten seconds after the last tick, where the library waits for ever
static inline void drive_goto(int32_t distLeft, int32_t distRight) {
  int32_t way[2] = {distLeft, distRight};
  drive_start();
  drive_speed(0, 0);
  int16_t top_before = drive_top;
  frames_due();  // those before this call
  uint8_t old = SREG;
  cli();
  drive_still = 0;
  drive_goto_frame = drive_go_on;
  drive_top = 64;
  for (uint8_t side = 0; side < 2; side++) {
    Wheel *wheel = &wheels[side];
    int32_t own = labs(way[side]), most = labs(way[!side]);
    bool close = labs(wheel->goal - wheel->ticks) < 6;  // what was missed is made up for
    wheel->goal = (close ? wheel->goal : wheel->ticks) + way[side];
    wheel->top = own < most ? 64 * own / most : 64;
    wheel->top_finer = own < most ? 64 * own % most * 50 / most : 0;
    wheel->top_finer_sum = 0;
    change_by(wheel, drive_goto_step, own, most);
    wheel->going = 1;
  }
  SREG = old;
  if (drive_goto_waits) {
    while (drive_on_the_way()) {}
    clock_wait(40);
    while (drive_on_the_way()) {}
  }
  drive_top = top_before;
}

//# adapter drive_gotoMode
//#   for: void drive_gotoMode(int mode)
//#   kind: oneToOne
//#   needs: drive_going
//#   fidelity: 1, drive_goto waits; 0, it returns at once
static inline void drive_gotoMode(int32_t mode) {
  drive_goto_waits = mode == 1;
}

//# adapter drive_gotoStatus
//#   for: int drive_gotoStatus(int side)
//#   kind: oneToOne
//#   needs: wheels SIDE_LEFT SIDE_RIGHT
//#   fidelity: 0 there, 1 on the way, 2 coming to a stand, 3 making up for missing ticks; the sum of both for SIDE_BOTH
static inline int32_t drive_gotoStatus(int32_t side) {
  return (side == SIDE_RIGHT ? 0 : wheels[0].going) + (side == SIDE_LEFT ? 0 : wheels[1].going);
}

//# adapter drive_setMaxSpeed
//#   for: void drive_setMaxSpeed(int speed)
//#   kind: oneToOne
//#   needs: drive_top
//#   fidelity: exact
static inline void drive_setMaxSpeed(int32_t speed) {
  drive_top = speed;
}

//# adapter drive_setMaxVelocity
//#   for: void drive_setMaxVelocity(int forGotoOrSpeed, int ticksPerSec)
//#   kind: oneToOne
//#   needs: FOR_SPEED FOR_GOTO drive_top
//#   fidelity: FOR_GOTO too sets the limit of drive_speed, as there
static inline void drive_setMaxVelocity(int32_t forGotoOrSpeed, int32_t ticksPerSec) {
  if (forGotoOrSpeed == FOR_SPEED || forGotoOrSpeed == FOR_GOTO) drive_top = ticksPerSec;
}

//# adapter drive_setRampStep
//#   for: void drive_setRampStep(int stepsize)
//#   kind: oneToOne
//#   needs: drive_step
//#   fidelity: exact
static inline void drive_setRampStep(int32_t stepsize) {
  drive_step = stepsize;
}

//# adapter drive_setAcceleration
//#   for: void drive_setAcceleration(int forGotoOrSpeed, int ticksPerSecSq)
//#   kind: oneToOne
//#   needs: FOR_SPEED FOR_GOTO drive_step drive_goto_step
//#   include: <stdlib.h>
//#   fidelity: FOR_SPEED sets that of drive_goto too, as there
static inline void drive_setAcceleration(int32_t forGotoOrSpeed, int32_t ticksPerSecSq) {
  int16_t step = labs(ticksPerSecSq) / 50;
  if (forGotoOrSpeed == FOR_SPEED) drive_step = step;
  if (forGotoOrSpeed == FOR_SPEED || forGotoOrSpeed == FOR_GOTO) drive_goto_step = step;
}

//# adapter drive_servoPins
//#   for: void drive_servoPins(int servoPinLeft, int servoPinRight)
//#   kind: semantic
//#   needs: drive_pins
//#   pin: servoPinLeft digital out servo
//#   pin: servoPinRight digital out servo
//#   fidelity: for the first start of the drive after the call
//#   limit: not kept for the next start of the program, as the library keeps it in EEPROM
static inline void drive_servoPins(int32_t servoPinLeft, int32_t servoPinRight) {
  drive_pins[0] = servoPinLeft;
  drive_pins[1] = servoPinRight;
}

//# adapter drive_encoderPins
//#   for: void drive_encoderPins(int encPinLeft, int encPinRight)
//#   kind: semantic
//#   needs: drive_encoders
//#   pin: encPinLeft digital in encoder
//#   pin: encPinRight digital in encoder
//#   fidelity: for the first start of the drive after the call
//#   limit: not kept for the next start of the program, as the library keeps it in EEPROM
static inline void drive_encoderPins(int32_t encPinLeft, int32_t encPinRight) {
  drive_encoder_pins[0] = encPinLeft;
  drive_encoder_pins[1] = encPinRight;
}
