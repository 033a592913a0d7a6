//# header abdrive360.h
// The drive of the ActivityBot 360: two servos with feedback, 64 ticks a turn. Read from Simple-Libraries 1cc167c10,
// Learn/Simple Libraries/Robotics/ActivityBot360/libabdrive360 (abdrive360.c and .h, and its files of one function each).

//# constant FOR_SPEED
//#   fidelity: exact
#define FOR_SPEED 0

//# constant FOR_GOTO
//#   fidelity: exact
#define FOR_GOTO 1

//# constant OFF
//#   fidelity: exact
#define OFF 0

//# constant ON
//#   fidelity: exact
#define ON 1

//# constant SIDE_LEFT
//#   fidelity: exact
#define SIDE_LEFT 0

//# constant SIDE_RIGHT
//#   fidelity: exact
#define SIDE_RIGHT 1

//# constant SIDE_BOTH
//#   fidelity: exact
#define SIDE_BOTH 2

//# constant ABD360_GOTO_BLOCK
//#   fidelity: exact
#define ABD360_GOTO_BLOCK 0

//# constant ABD360_GOTO_SET_FORGET
//#   fidelity: exact
#define ABD360_GOTO_SET_FORGET 1

//# constant ABD360_GOTO_BUSY
//#   fidelity: exact
#define ABD360_GOTO_BUSY 1

//# constant ABD360_GOTO_CLEAR
//#   fidelity: exact
#define ABD360_GOTO_CLEAR 0

//# helper Drive360
//#   port: left_servo_360 = abdrive360.left_servo 12 digital out servo
//#   port: right_servo_360 = abdrive360.right_servo 13 digital out servo
//#   port: left_encoder_360 = abdrive360.left_encoder 14 digital in feedback
//#   port: right_encoder_360 = abdrive360.right_encoder 15 digital in feedback
//#   ram: 34
struct Drive360 {
  int32_t left, right, left_signal, right_signal;         // pins
  int32_t top, step, goto_top, goto_step;                 // ticks/s, and ticks/s each 20 ms
  bool goto_waits, on;
};
static Drive360 drive360 = {left_servo_360, right_servo_360, left_encoder_360, right_encoder_360, 128, 12, 64, 8, true, false};

//# helper drive360_limits
//#   needs: Drive360 servo360.h/servo360_setAcceleration servo360.h/servo360_setMaxSpeed
inline void drive360_limits(int32_t top, int32_t step) {
  int32_t sides[2] = {drive360.left, drive360.right};
  for (int32_t pin : sides) {
    servo360_setAcceleration(pin, step * 50);
    servo360_setMaxSpeed(pin, top);
  }
}

//# helper drive_init
//#   needs: Drive360 drive360_limits servo360.h/S360_SETTING_IA_MAX servo360.h/S360_SETTING_KDA servo360.h/S360_SETTING_KIA servo360.h/S360_SETTING_KPA servo360.h/servo360_connect servo360.h/servo360_couple servo360.h/servo360_setControlSys servo360.h/servo360_setUnitsFullCircle
inline void drive_init() {
  if (drive360.on) return;
  if (drive360.left == 255 && drive360.right == 255) drive360.right = 254;  // two servos without a pin are two all the same
  bool waited = false;
  while (servo360_connect(drive360.left, drive360.left_signal) < 0) waited = true, yield();
  while (servo360_connect(drive360.right, drive360.right_signal) < 0) waited = true, yield();
  if (waited) delay(200);
  int32_t sides[2] = {drive360.left, drive360.right};
  for (int32_t pin : sides) {
    servo360_setUnitsFullCircle(pin, 64);
    servo360_setControlSys(pin, S360_SETTING_KPA, 5000);
    servo360_setControlSys(pin, S360_SETTING_KIA, 150);
    servo360_setControlSys(pin, S360_SETTING_KDA, 0);
    servo360_setControlSys(pin, S360_SETTING_IA_MAX, 150);
  }
  servo360_couple(drive360.left, drive360.right);
  drive360_limits(drive360.top, drive360.step);
  drive360.on = true;
}

//# adapter drive_speed
//#   for: void drive_speed(int left, int right)
//#   kind: oneToMany
//#   needs: Drive360 drive360_limits drive_init servo360.h/servo360_speed
//#   role: servo
//#   fidelity: returns at once while the ramp goes on; the first call waits for both feedback signals and half a second, as there
//#   limit: the calibration of the source robot does not carry over: the library's standard transfer function is used
//#   limit: without feedback wired the drive goes on the speed alone
//#   stack: 132 114
//#   interrupt: PCINT0_vect 21
//#   interrupt: PCINT1_vect 38
//#   interrupt: PCINT2_vect 38
//#   interrupt: TIMER0_COMPA_vect 107 107
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline void drive_speed(int32_t left, int32_t right) {
  drive_init();
  drive360_limits(drive360.top, drive360.step);
  servo360_speed(drive360.left, left);
  servo360_speed(drive360.right, -right);
}

//# adapter drive_rampStep
//#   for: void drive_rampStep(int left, int right)
//#   kind: oneToOne
//#   needs: drive_speed
//#   role: servo
//#   fidelity: the same as drive_speed, as there
//#   stack: 132 114
//#   interrupt: PCINT0_vect 21
//#   interrupt: PCINT1_vect 38
//#   interrupt: PCINT2_vect 38
//#   interrupt: TIMER0_COMPA_vect 107 107
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline void drive_rampStep(int32_t left, int32_t right) {
  drive_speed(left, right);
}

//# adapter drive_ramp
//#   for: void drive_ramp(int left, int right)
//#   kind: oneToMany
//#   needs: Drive360 drive_speed servo360.h/servo360_getSpeed
//#   role: servo
//#   fidelity: returns when a side is within 4 ticks/s of its speed, as there; the right servo counts backwards, so that it counts only at a stand
//#   stack: 132 114
//#   interrupt: PCINT0_vect 21
//#   interrupt: PCINT1_vect 38
//#   interrupt: PCINT2_vect 38
//#   interrupt: TIMER0_COMPA_vect 107 107
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline void drive_ramp(int32_t left, int32_t right) {
  drive_speed(left, right);
  while (abs(servo360_getSpeed(drive360.left) - left) >= 4 && abs(servo360_getSpeed(drive360.right) - right) >= 4) delay(20);
}

//# adapter drive_getTicks
//#   for: void drive_getTicks(int *left, int *right)
//#   kind: oneToMany
//#   needs: Drive360 drive_init servo360.h/servo360_getAngle
//#   role: servo
//#   fidelity: within a tick; the right side counts down when the robot goes forward, as there
//#   stack: 142 130
//#   interrupt: PCINT0_vect 21
//#   interrupt: PCINT1_vect 38
//#   interrupt: PCINT2_vect 38
//#   interrupt: TIMER0_COMPA_vect 107 107
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
template <class Int> inline void drive_getTicks(Int *left, Int *right) {
  drive_init();
  *left = servo360_getAngle(drive360.left);
  *right = servo360_getAngle(drive360.right);
}

//# adapter drive_getTicksCalc
//#   for: void drive_getTicksCalc(int *left, int *right)
//#   kind: oneToMany
//#   needs: Drive360 drive_init servo360.h/servo360_getAngleCalc
//#   fidelity: as calculated from the speed, as there
//#   stack: 142 130
//#   interrupt: PCINT0_vect 21
//#   interrupt: PCINT1_vect 38
//#   interrupt: PCINT2_vect 38
//#   interrupt: TIMER0_COMPA_vect 107 107
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
template <class Int> inline void drive_getTicksCalc(Int *left, Int *right) {
  drive_init();
  *left = servo360_getAngleCalc(drive360.left);
  *right = servo360_getAngleCalc(drive360.right);
}

//# adapter drive_goto
//#   for: void drive_goto(int distLeft, int distRight)
//#   kind: oneToMany
//#   needs: Drive360 drive360_limits drive_init servo360.h/S360_GOTO servo360.h/servo360_getCsop servo360.h/servo360_getMaxSpeed servo360.h/servo360_getRampStep servo360.h/servo360_goto servo360.h/servo360_setMaxSpeed servo360.h/servo360_setRampStep
//#   role: servo
//#   fidelity: both sides so many ticks, the shorter way slower; returns a second after the first of them is there, as there
//#   stack: 136 120
//#   interrupt: PCINT0_vect 21
//#   interrupt: PCINT1_vect 38
//#   interrupt: PCINT2_vect 38
//#   interrupt: TIMER0_COMPA_vect 107 107
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline void drive_goto(int32_t distLeft, int32_t distRight) {
  drive_init();
  drive360_limits(drive360.goto_top, drive360.goto_step);
  int32_t left = abs(distLeft), right = abs(distRight);
  if (left != right) {
    int32_t slower = left < right ? drive360.left : drive360.right;
    int32_t ratio = 1000 * min(left, right) / max(left, right);
    int32_t step = servo360_getRampStep(slower) * ratio / 1000;
    servo360_setRampStep(slower, step ? step : 1);
    servo360_setMaxSpeed(slower, servo360_getMaxSpeed(slower) * ratio / 1000);
  }
  servo360_goto(drive360.left, distLeft);
  servo360_goto(drive360.right, -distRight);
  while (drive360.goto_waits && servo360_getCsop(drive360.left) == S360_GOTO && servo360_getCsop(drive360.right) == S360_GOTO) yield();
  delay(1000);
}

//# adapter drive_gotoMode
//#   for: void drive_gotoMode(int mode)
//#   kind: oneToOne
//#   needs: Drive360 drive_init ABD360_GOTO_BLOCK
//#   fidelity: ABD360_GOTO_BLOCK, drive_goto waits; else it returns after a second, as there
//#   stack: 138 130
//#   interrupt: PCINT0_vect 21
//#   interrupt: PCINT1_vect 38
//#   interrupt: PCINT2_vect 38
//#   interrupt: TIMER0_COMPA_vect 107 107
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline void drive_gotoMode(int32_t mode) {
  drive_init();
  drive360.goto_waits = mode == ABD360_GOTO_BLOCK;
}

//# adapter drive_gotoStatus
//#   for: int drive_gotoStatus(int side)
//#   kind: oneToOne
//#   needs: Drive360 drive_init SIDE_LEFT SIDE_RIGHT servo360.h/S360_GOTO servo360.h/servo360_getCsop
//#   fidelity: how many of the sides asked for are on the way
//#   stack: 142 130
//#   interrupt: PCINT0_vect 21
//#   interrupt: PCINT1_vect 38
//#   interrupt: PCINT2_vect 38
//#   interrupt: TIMER0_COMPA_vect 107 107
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t drive_gotoStatus(int32_t side) {
  drive_init();
  return (side != SIDE_RIGHT && servo360_getCsop(drive360.left) == S360_GOTO) + (side != SIDE_LEFT && servo360_getCsop(drive360.right) == S360_GOTO);
}

//# adapter drive_feedback
//#   for: void drive_feedback(int enabled)
//#   kind: oneToMany
//#   needs: Drive360 drive_init servo360.h/servo360_feedback
//#   fidelity: as servo360_feedback of both sides, as there
//#   stack: 142 126
//#   interrupt: PCINT0_vect 21
//#   interrupt: PCINT1_vect 38
//#   interrupt: PCINT2_vect 38
//#   interrupt: TIMER0_COMPA_vect 107 107
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline void drive_feedback(int32_t enabled) {
  drive_init();
  servo360_feedback(drive360.left, enabled);
  servo360_feedback(drive360.right, enabled);
}

//# adapter drive_setMaxSpeed
//#   for: void drive_setMaxSpeed(int speed)
//#   kind: oneToMany
//#   needs: Drive360 drive_init servo360.h/servo360_setMaxSpeed
//#   fidelity: until the next drive_speed or drive_goto, which set their own, as there
//#   stack: 142 126
//#   interrupt: PCINT0_vect 21
//#   interrupt: PCINT1_vect 38
//#   interrupt: PCINT2_vect 38
//#   interrupt: TIMER0_COMPA_vect 107 107
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline void drive_setMaxSpeed(int32_t speed) {
  drive_init();
  servo360_setMaxSpeed(drive360.left, speed);
  servo360_setMaxSpeed(drive360.right, speed);
}

//# adapter drive_setMaxVelocity
//#   for: void drive_setMaxVelocity(int forGotoOrSpeed, int ticksPerSec)
//#   kind: oneToOne
//#   needs: Drive360 drive_init FOR_GOTO FOR_SPEED
//#   fidelity: exact
//#   stack: 138 134
//#   interrupt: PCINT0_vect 21
//#   interrupt: PCINT1_vect 38
//#   interrupt: PCINT2_vect 38
//#   interrupt: TIMER0_COMPA_vect 107 107
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline void drive_setMaxVelocity(int32_t forGotoOrSpeed, int32_t ticksPerSec) {
  drive_init();
  if (forGotoOrSpeed == FOR_SPEED) drive360.top = ticksPerSec;
  if (forGotoOrSpeed == FOR_GOTO) drive360.goto_top = ticksPerSec;
}

//# adapter drive_setAcceleration
//#   for: void drive_setAcceleration(int forGotoOrSpeed, int ticksPerSecSq)
//#   kind: oneToOne
//#   needs: Drive360 drive_init FOR_GOTO FOR_SPEED servo360.h/servo360_setAcceleration
//#   fidelity: exact; that for speeds holds for a ramp that goes on, too, as there
//#   stack: 146 134
//#   interrupt: PCINT0_vect 21
//#   interrupt: PCINT1_vect 38
//#   interrupt: PCINT2_vect 38
//#   interrupt: TIMER0_COMPA_vect 107 107
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline void drive_setAcceleration(int32_t forGotoOrSpeed, int32_t ticksPerSecSq) {
  drive_init();
  if (forGotoOrSpeed == FOR_SPEED) {
    drive360.step = ticksPerSecSq / 50;
    servo360_setAcceleration(drive360.left, ticksPerSecSq);
    servo360_setAcceleration(drive360.right, ticksPerSecSq);
  }
  if (forGotoOrSpeed == FOR_GOTO) drive360.goto_step = ticksPerSecSq / 50;
}

//# adapter drive_setRampStep
//#   for: void drive_setRampStep(int stepsize)
//#   kind: oneToMany
//#   needs: Drive360 drive_init servo360.h/servo360_setAcceleration
//#   fidelity: until the next drive_speed or drive_goto, which set their own, as there
//#   stack: 142 130
//#   interrupt: PCINT0_vect 21
//#   interrupt: PCINT1_vect 38
//#   interrupt: PCINT2_vect 38
//#   interrupt: TIMER0_COMPA_vect 107 107
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline void drive_setRampStep(int32_t stepsize) {
  drive_init();
  servo360_setAcceleration(drive360.left, stepsize * 50);
  servo360_setAcceleration(drive360.right, stepsize * 50);
}

//# adapter drive_servoPins
//#   for: void drive_servoPins(int controlPinLeft, int controlPinRight)
//#   kind: oneToOne
//#   needs: Drive360
//#   pin: controlPinLeft digital out servo
//#   pin: controlPinRight digital out servo
//#   fidelity: for the first start of the drive after the call
//#   limit: not kept for the next start of the program, as the library keeps it in EEPROM
//#   stack: 0
inline void drive_servoPins(int32_t controlPinLeft, int32_t controlPinRight) {
  drive360.left = controlPinLeft;
  drive360.right = controlPinRight;
}

//# adapter drive_encoderPins
//#   for: void drive_encoderPins(int encPinLeft, int encPinRight)
//#   kind: oneToOne
//#   needs: Drive360
//#   pin: encPinLeft digital in encoder
//#   pin: encPinRight digital in encoder
//#   fidelity: for the first start of the drive after the call
//#   limit: not kept for the next start of the program, as the library keeps it in EEPROM
//#   stack: 0
inline void drive_encoderPins(int32_t encPinLeft, int32_t encPinRight) {
  drive360.left_signal = encPinLeft;
  drive360.right_signal = encPinRight;
}

//# adapter drive360_ticksPerRev
//#   for: void drive360_ticksPerRev(int units)
//#   kind: oneToMany
//#   needs: Drive360 drive_init servo360.h/servo360_setUnitsFullCircle
//#   fidelity: exact; the library's source calls it drive360_unitsPerRev
//#   stack: 142 126
//#   interrupt: PCINT0_vect 21
//#   interrupt: PCINT1_vect 38
//#   interrupt: PCINT2_vect 38
//#   interrupt: TIMER0_COMPA_vect 107 107
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline void drive360_ticksPerRev(int32_t units) {
  drive_init();
  servo360_setUnitsFullCircle(drive360.left, units);
  servo360_setUnitsFullCircle(drive360.right, units);
}

//# adapter drive_suppress_eeprom
//#   for: void drive_suppress_eeprom(int state)
//#   kind: oneToOne
//#   fidelity: nothing of EEPROM is read or kept here, whatever it says
//#   stack: 0
inline void drive_suppress_eeprom(int32_t state) {
  (void)state;
}
