/* abdrive360.h: the drive on servo360.h, 64 units a turn; the right wheel turns the other way round. A calibration in the EEPROM is not
 * read. Sources: libabdrive360 (abdrive360.c and a file for each function). */
#include "abdrive360.h"

enum { SETTINGS = _AB360_EE_Start_ + _AB360_EE_Pins_ };
static int ready, no_eeprom, left_servo = 12, right_servo = 13, left_encoder = 14, right_encoder = 15;
static int speed_limit = ABD_SPEED_LIMIT, ramp_step = ABD_RAMP_STEP, goto_limit = ABD_GOTO_SPEED_LIMIT, goto_step = ABD_GOTO_RAMP_STEP;
static int goto_mode = ABD360_GOTO_BLOCK;

static int magnitude(int value) { return value < 0 ? -value : value; }

static void both(int (*set)(int pin, int value), int value) {
  set(left_servo, value);
  set(right_servo, value);
}

static void tune(int constant, int value) {
  servo360_setControlSys(left_servo, constant, value);
  servo360_setControlSys(right_servo, constant, value);
}

static void read_pins(void) {
  unsigned char kept[16];
  ee_getStr(kept, 16, SETTINGS);
  if (kept[0] == 's' && kept[1] == 'p' && kept[2] == 'L' && kept[5] == 'R') left_servo = kept[3], right_servo = kept[6];
  if (kept[8] == 'e' && kept[9] == 'p' && kept[10] == 'L' && kept[13] == 'R') left_encoder = kept[11], right_encoder = kept[14];
}

/* Tries until both servos tell their angle. */
void drive_init(void) {
  int again = 0;
  if (!no_eeprom) read_pins();
  while (servo360_connect(left_servo, left_encoder) < 0) again = 1;
  while (servo360_connect(right_servo, right_encoder) < 0) again = 1;
  if (again) pause(200);
  both(servo360_setUnitsFullCircle, ABD360_UNITS_REV);
  both(servo360_setAcceleration, ramp_step * 50);
  both(servo360_setMaxSpeed, speed_limit);
  servo360_couple(left_servo, right_servo);
  tune(S360_SETTING_KPA, 5000);
  tune(S360_SETTING_KIA, 150);
  tune(S360_SETTING_KDA, 0);
  tune(S360_SETTING_IA_MAX, 150);
  ready = 1;
}

static void start(void) {
  if (!ready) drive_speed(0, 0);
}

void drive_speed(int left, int right) {
  if (!ready) drive_init();
  both(servo360_setAcceleration, ramp_step * 50);
  both(servo360_setMaxSpeed, speed_limit);
  servo360_speed(left_servo, left);
  servo360_speed(right_servo, -right);
}

void drive_rampStep(int left, int right) { drive_speed(left, right); }

/* As in the library, the right wheel's speed is compared with its sign turned round. */
void drive_ramp(int left, int right) {
  drive_speed(left, right);
  while (magnitude(servo360_getSpeed(left_servo) - left) >= 4 && magnitude(servo360_getSpeed(right_servo) - right) >= 4) pause(20);
}

static void slow(int pin, int way, int longer_way) {
  int ratio = 1000 * magnitude(way) / magnitude(longer_way);
  int step = servo360_getRampStep(pin) * ratio / 1000, limit = servo360_getMaxSpeed(pin) * ratio / 1000;
  servo360_setRampStep(pin, step);
  servo360_setMaxSpeed(pin, limit);
}

void drive_goto(int distLeft, int distRight) {
  if (!ready) drive_init();
  both(servo360_setAcceleration, goto_step * 50);
  both(servo360_setMaxSpeed, goto_limit);
  if (magnitude(distRight) > magnitude(distLeft)) slow(left_servo, distLeft, distRight);
  else if (magnitude(distLeft) > magnitude(distRight)) slow(right_servo, distRight, distLeft);
  servo360_goto(left_servo, distLeft);
  servo360_goto(right_servo, -distRight);
  if (goto_mode == ABD360_GOTO_BLOCK)
    while (servo360_getCsop(left_servo) == S360_GOTO && servo360_getCsop(right_servo) == S360_GOTO) {}
  pause(1000);
}

void drive_gotoMode(int mode) {
  start();
  goto_mode = mode;
}

int drive_gotoStatus(int side) {
  if (!ready) drive_init();
  int left = side != SIDE_RIGHT && servo360_getCsop(left_servo) == S360_GOTO;
  return left + (side != SIDE_LEFT && servo360_getCsop(right_servo) == S360_GOTO);
}

void drive_getTicks(int *left, int *right) {
  start();
  *left = servo360_getAngle(left_servo);
  *right = servo360_getAngle(right_servo);
}

void drive_getTicksCalc(int *left, int *right) {
  start();
  *left = servo360_getAngleCalc(left_servo);
  *right = servo360_getAngleCalc(right_servo);
}

void drive_feedback(int enabled) {
  start();
  both(servo360_feedback, enabled);
}

void drive360_unitsPerRev(int units) {
  start();
  both(servo360_setUnitsFullCircle, units);
}

void drive_setMaxSpeed(int speed) {
  start();
  both(servo360_setMaxSpeed, speed);
}

void drive_setMaxVelocity(int forGotoOrSpeed, int ticksPerSec) {
  start();
  if (forGotoOrSpeed == FOR_GOTO) goto_limit = ticksPerSec;
  if (forGotoOrSpeed == FOR_SPEED) both(servo360_setMaxSpeed, speed_limit = ticksPerSec);
}

void drive_setRampStep(int stepsize) {
  start();
  both(servo360_setAcceleration, stepsize * 50);
}

void drive_setAcceleration(int forGotoOrSpeed, int ticksPerSecSq) {
  start();
  if (forGotoOrSpeed == FOR_GOTO) goto_step = ticksPerSecSq / 50;
  if (forGotoOrSpeed != FOR_SPEED) return;
  ramp_step = ticksPerSecSq / 50;
  both(servo360_setAcceleration, ticksPerSecSq);
}

void drive_suppress_eeprom(int state) { no_eeprom = state; }

static void keep_pins(char kind, int left, int right, int offset) {
  unsigned char bytes[8] = {kind, 'p', 'L', (unsigned char)left, ' ', 'R', (unsigned char)right, ' '};
  if (!no_eeprom) ee_putStr(bytes, 8, SETTINGS + offset);
}

void drive_servoPins(int controlPinLeft, int controlPinRight) {
  keep_pins('s', controlPinLeft, controlPinRight, 0);
  left_servo = controlPinLeft, right_servo = controlPinRight;
}

void drive_encoderPins(int encPinLeft, int encPinRight) {
  keep_pins('e', encPinLeft, encPinRight, 8);
  left_encoder = encPinLeft, right_encoder = encPinRight;
}

void drive360_ticksPerRev(int units) { drive360_unitsPerRev(units); }  /* what the header declares; the source has the other name */
