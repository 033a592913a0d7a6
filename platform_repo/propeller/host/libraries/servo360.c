/* servo360.h: a cog reads the angle of up to four servos from the duty of their feedback, 4,096 steps a turn, and controls angle or speed
 * 50 times a second; pulses are in tenths of a microsecond. Sources: libservo360 (servo360.c and a file for each function). */
#include "servo360.h"

static volatile struct servo {
  int used, control_pin, feedback_pin, enabled, feedback, mode;
  int duty, theta, turns, angle_fixed, angle, angle_before, offset;       /* where it stands, in steps */
  int units, least_angle, most_angle, speed_limit, control_limit, ramp_step;
  int m_ccw, m_cw, b_ccw, b_cw;                                           /* pulse for a speed, in each sense */
  int asked_speed, target_speed, measured_speed, drive;
  int calculated, error, distance, distance_before, integral_v, most_integral_v, kp_v, ki_v, kd_v, output_v;
  int set_point, deviation_before, integral, most_integral, kp, ki, kd, target_angle, approaching;
  int partner, partner_scale;
  int out;                                                                /* beyond neutral, as it is sent */
  int aim;                                                                /* as it was told last, plus 1 */
} servos[S360_DEVS_MAX];
static int connected;
static int *cog;

static int magnitude(int value) { return value < 0 ? -value : value; }
static int within(int value, int limit) { return value > limit ? limit : value < -limit ? -limit : value; }

/* ---- reading the angle */

/* High time of a cycle of the feedback, as a part of `scale`; -1 when no cycle is seen within 3 ms. */
static int duty_of(int pin, int scale) {
  unsigned mask = 1u << (pin & 31);
  host_time begun = host_now(), end = begun + 3 * HOST_TICKS_PER_MS, rise, fall;
  host_wait_pins(mask, 0, 1, end);
  host_wait_pins(mask, mask, 1, end);
  rise = host_now();
  host_wait_pins(mask, 0, 1, end);
  fall = host_now();
  host_wait_pins(mask, mask, 1, end);
  if (host_now() >= end) return -1;
  return (int)((fall - rise) * scale / (host_now() - rise));
}

static void read_theta(volatile struct servo *servo) {
  servo->duty = duty_of(servo->feedback_pin, S360_M);
  servo->theta = (S360_ENC_RES - 1 - (servo->duty + S360_B)) & 0xFFF;
}

static void read_angle(volatile struct servo *servo) {
  int before = servo->theta, low = S360_UNITS_ENCODER / 3, high = 2 * (S360_UNITS_ENCODER / 3);
  servo->angle_before = servo->angle;
  read_theta(servo);
  if (before > high && servo->theta < low) servo->turns++;
  if (before < low && servo->theta > high) servo->turns--;
  servo->angle_fixed = servo->turns * S360_UNITS_ENCODER + servo->theta;
  servo->angle = servo->angle_fixed - servo->offset;
}

/* ---- control */

static void forget_speed(volatile struct servo *servo) {
  servo->target_speed = servo->error = servo->distance = servo->distance_before = servo->integral_v = 0;
}

static void forget_angle(volatile struct servo *servo) { servo->integral = servo->deviation_before = 0; }

static int pulse_for(const volatile struct servo *servo, int speed) {
  if (speed > 0) return servo->m_ccw * speed / 1000 + servo->b_ccw;
  return speed < 0 ? servo->m_cw * speed / 1000 + servo->b_cw : 0;
}

static void control_angle(volatile struct servo *servo) {
  forget_speed(servo);
  int deviation = servo->set_point - servo->angle, change = deviation - servo->deviation_before;
  servo->integral = within(servo->integral + deviation, servo->most_integral);
  int output = servo->kp * deviation / S360_SCALE_DEN_A + servo->ki * servo->integral / S360_SCALE_DEN_A + servo->kd * change / S360_SCALE_DEN_A;
  servo->deviation_before = deviation;
  servo->out = pulse_for(servo, within(output, servo->control_limit));
}

static int correction(volatile struct servo *servo) {
  int half = S360_UNITS_ENCODER / 2, step = servo->target_speed / S360_CS_HZ, before = servo->error, change = 0;
  servo->measured_speed = (servo->angle - servo->angle_before) * 50;
  servo->calculated += step;
  servo->error = servo->calculated - servo->angle;
  if (magnitude(servo->error) >= half && magnitude(servo->error) > magnitude(before)) {
    servo->calculated -= step;
    servo->error = before;
  }
  if (magnitude(servo->error) < half) {
    servo->distance = servo->error;
    servo->integral_v += servo->distance;
    change = servo->distance - servo->distance_before;
  }
  servo->integral_v = within(servo->integral_v, servo->most_integral_v);
  servo->distance_before = servo->distance;
  int output = servo->kp_v * servo->distance / S360_SCALE_DEN_V + servo->ki_v * servo->integral_v / S360_SCALE_DEN_V + servo->kd_v * change / S360_SCALE_DEN_V;
  return within(output, servo->speed_limit);
}

static void control_speed(volatile struct servo *servo) {
  forget_angle(servo);
  if (servo->target_speed != servo->asked_speed) {
    if (magnitude(servo->error) < S360_UNITS_ENCODER / 2)
      servo->target_speed += within(servo->asked_speed - servo->target_speed, servo->ramp_step);
    servo->drive = pulse_for(servo, servo->target_speed);
  }
  servo->out = servo->output_v = servo->drive + correction(servo);
}

static void control_goto(volatile struct servo *servo) {
  int left = servo->target_angle - servo->angle, speed = servo->asked_speed;
  int guard = speed * magnitude(speed) / (100 * servo->ramp_step) + S360_LATENCY * speed / 50;
  if (!servo->approaching && left) {
    int far = left < 0 ? left < guard : left > guard;
    if (far) servo->asked_speed = left < 0 ? -servo->speed_limit : servo->speed_limit;
    else servo->asked_speed = 0, servo->approaching = 1;
  }
  control_speed(servo);
  if (magnitude(left) < servo->ramp_step / (servo->units * 50) || (servo->approaching && servo->measured_speed == 0)) {
    servo->asked_speed = servo->target_speed = servo->approaching = 0;
    servo->set_point = servo->target_angle;
    servo->mode = S360_POSITION;
  }
}

static int lag_of(const volatile struct servo *servo) {
  return servo->target_speed > 0 ? servo->error : servo->target_speed < 0 ? -servo->error : 0;
}

static void slow_down(volatile struct servo *servo, int by) {
  if (servo->out > 0) servo->out -= by;
  if (servo->out < 0) servo->out += by;
}

/* Of two coupled servos the one that is ahead is slowed down. */
static void couple(volatile struct servo *servo) {
  volatile struct servo *other = &servos[servo->partner];
  int behind = lag_of(servo) - lag_of(other), by = servo->partner_scale * magnitude(behind) / S360_SCALE_DEN_COUPLE;
  if (by > 500) by = 500;
  if (behind < 0) slow_down(servo, by);
  if (behind > 0) slow_down(other, by);
}

/* ---- the cog */

static int is_driven(int place) { return place < S360_DEVS_MAX && servos[place].used && servos[place].duty != -1; }

static void send_pulses(int first) {
  unsigned mask = 0;
  for (int side = 0; side < 2; side++) {
    volatile struct servo *servo = &servos[first + side];
    if (!is_driven(first + side) || !servo->enabled) continue;
    if (servo->out > S360_PWMAX) servo->out = S360_PWMAX;
    if (servo->out < S360_PWMIN) servo->out = S360_PWMIN;
    low(servo->control_pin);
    *host_register(HOST_PHSA + side) = 0;
    *host_register(HOST_FRQA + side) = 1;
    *host_register(HOST_CTRA + side) = 4u << 26 | (servo->control_pin & 31);
    *host_register(HOST_PHSA + side) = -(S360_PW_CENTER + servo->out) * (HOST_HZ / 10000000);
    mask |= 1u << (servo->control_pin & 31);
  }
  if (mask) host_wait_pins(mask, 0, 1, HOST_NEVER);
  CTRA = CTRB = 0;
}

static void control(void *unused) {
  (void)unused;
  for (host_time frame = host_now();; frame += HOST_HZ / 50) {
    for (int i = 0; i < S360_DEVS_MAX; i++)
      if (servos[i].used) read_angle(&servos[i]);
    for (int i = 0; i < S360_DEVS_MAX; i++) {
      volatile struct servo *servo = &servos[i];
      if (!servo->used || !servo->feedback || servo->duty == -1) continue;
      if (servo->mode == S360_POSITION) control_angle(servo);
      else if (servo->mode == S360_SPEED) control_speed(servo);
      else if (servo->mode == S360_GOTO) control_goto(servo);
    }
    for (int i = 0; i < S360_DEVS_MAX; i++)
      if (servos[i].feedback) couple(&servos[i]);
    for (int pair = 0; pair < 2; pair++) {
      host_time when = frame + (16 + 2 * pair) * HOST_TICKS_PER_MS;
      if (when > host_now()) host_spend(when - host_now());
      send_pulses(2 * pair);
    }
    if (frame + HOST_HZ / 50 > host_now()) host_spend(frame + HOST_HZ / 50 - host_now());
  }
}

static void start(void) {
  host_call();
  if (cog) return;
  cog = cog_run(control, 512);
  pause(500);
}

int servo360_findServoIndex(int pin) {
  for (int i = 0; i < S360_DEVS_MAX; i++)
    if (servos[i].used && (servos[i].control_pin == pin || servos[i].feedback_pin == pin)) return i;
  return -1;
}

static volatile struct servo *found(int pin) {
  start();
  int place = servo360_findServoIndex(pin);
  return place < 0 ? 0 : &servos[place];
}

static int place_of(volatile struct servo *servo) { return servo - servos; }

static void begin_angle(volatile struct servo *servo) {
  servo->theta = servo->duty = 0;
  read_theta(servo);
  servo->angle_fixed = servo->offset = servo->theta;
  servo->angle = servo->angle_before = servo->calculated = 0;
}

int servo360_connect(int pinControl, int pinFeedback) {
  long width = pulse_in(pinFeedback, 1);
  if (width > 1200 || width < 25) return -8;
  start();
  if (servo360_findServoIndex(pinControl) != -1) return -4;
  if (servo360_findServoIndex(pinFeedback) != -1) return -5;
  if (pinControl >= 28 && pinFeedback >= 28) return -6;
  if (connected >= S360_DEVS_MAX) return -7;
  volatile struct servo *servo = &servos[connected++];
  *servo = (struct servo){
    .control_pin = pinControl, .feedback_pin = pinFeedback, .enabled = 1, .feedback = 1, .units = S360_UNITS_REV,
    .least_angle = -S360_A_MAX, .most_angle = S360_A_MAX, .speed_limit = S360_MAX_SPEED, .control_limit = S360_MAX_SPEED,
    .ramp_step = S360_RAMP_STEP, .m_ccw = S360_VM_CCW, .m_cw = S360_VM_CW, .b_ccw = S360_VB_CCW, .b_cw = S360_VB_CW,
    .most_integral_v = S360_VEL_INTGRL_MAX, .kp_v = S360_KPV, .ki_v = S360_KIV, .kd_v = S360_KDV,
    .most_integral = S360_POS_INTGRL_MAX, .kp = S360_KPA, .ki = S360_KIA, .kd = S360_KDA};
  begin_angle(servo);
  servo->used = 1;
  return place_of(servo);
}

/* ---- what the program asks */

static void aims(volatile struct servo *servo, int aim) {
  if (servo->aim != aim + 1) host_aims(servo->control_pin, aim);
  servo->aim = aim + 1;
}

#define SERVO(pin) volatile struct servo *servo = found(pin); if (!servo) return -1

int servo360_unitsAngleToEncoder(int value, int unitsRev) { return value * S360_UNITS_ENCODER / unitsRev; }
int servo360_unitsEncoderToAngle(int value, int unitsRev) { return value * unitsRev / S360_UNITS_ENCODER; }

static int to_steps(const volatile struct servo *servo, int value) { return servo360_unitsAngleToEncoder(value, servo->units); }
static int to_units(const volatile struct servo *servo, int value) { return servo360_unitsEncoderToAngle(value, servo->units); }

int servo360_angle(int pin, int position) {
  SERVO(pin);
  if (position >= servo->most_angle) position = servo->most_angle;
  if (position <= servo->least_angle) position = servo->least_angle;
  servo->set_point = to_steps(servo, position);
  servo->mode = S360_POSITION;
  aims(servo, HOST_TO_A_PLACE);
  forget_speed(servo);
  return place_of(servo);
}

int servo360_speed(int pin, int speed) {
  SERVO(pin);
  speed = to_steps(servo, speed);
  if (speed == servo->asked_speed) return place_of(servo);
  if (servo->mode == S360_POSITION || servo->mode == S360_GOTO) servo->calculated = servo->target_angle;
  servo->asked_speed = within(speed, servo->speed_limit);
  servo->mode = S360_SPEED;
  aims(servo, HOST_FOR_A_TIME);
  forget_angle(servo);
  return place_of(servo);
}

int servo360_stop(int pin) { return servo360_speed(pin, 0); }

int servo360_goto(int pin, int position) {
  SERVO(pin);
  int from = servo->calculated;
  if (servo->mode == S360_POSITION) from = servo->calculated = servo->set_point;
  else if (servo->mode == S360_GOTO) from = servo->target_angle;
  servo->target_angle = to_steps(servo, position) + from;
  if (servo->mode == S360_GOTO) servo->approaching = 0;
  servo->mode = S360_GOTO;
  aims(servo, HOST_BY_A_WAY);
  return place_of(servo);
}

int servo360_set(int pinControl, int time) {
  SERVO(pinControl);
  servo->out = (time - 1500) * 10;
  aims(servo, HOST_FOR_A_TIME);
  return place_of(servo);
}

int servo360_enable(int pin, int state) {
  SERVO(pin);
  servo->enabled = state;
  pause(1);
  return place_of(servo);
}

int servo360_feedback(int pin, int state) {
  SERVO(pin);
  if (state == 1 && !servo->feedback) {
    forget_speed(servo);
    forget_angle(servo);
    begin_angle(servo);
  }
  servo->feedback = state;
  return place_of(servo);
}

int servo360_couple(int pinA, int pinB) {
  start();
  int a = servo360_findServoIndex(pinA), b = servo360_findServoIndex(pinB);
  if (a < 0) return -1;
  if (b < 0) return -2;
  if (a == b) return -3;
  int first = a < b ? a : b, second = a < b ? b : a;
  servos[first].partner = second;
  servos[first].partner_scale = S360_SCALE_COUPLE;
  return second;
}

int servo360_setCoupleScale(int pinA, int pinB, int scale) {
  start();
  int a = servo360_findServoIndex(pinA);
  if (a < 0) return -1;
  if (servo360_findServoIndex(pinB) < 0) return -2;
  servos[a].partner_scale = scale;
  return a;
}

int servo360_setTurns(int pin, int turns) {
  SERVO(pin);
  int steps = turns * S360_ENC_RES;
  servo->angle += steps, servo->angle_before += steps, servo->angle_fixed += steps, servo->turns += turns;
  int moved = servo->mode == S360_POSITION || servo->mode == S360_SPEED || servo->mode == S360_GOTO;  /* not before the first order */
  if (moved) servo->target_angle += steps;
  if (moved && servo->mode != S360_POSITION) servo->calculated += steps;
  if (moved && servo->mode != S360_SPEED) servo->set_point += steps;
  return place_of(servo);
}

int servo360_setAngleLimits(int pin, int ccwMax, int cwMax) {
  SERVO(pin);
  servo->most_angle = ccwMax;
  servo->least_angle = cwMax;
  return place_of(servo);
}

int servo360_getAngleLimits(int pin, int *ccwMax, int *cwMax) {
  SERVO(pin);
  *ccwMax = servo->most_angle;
  *cwMax = servo->least_angle;
  return place_of(servo);
}

int servo360_setAngleCtrlSpeedMax(int pin, int speed) {
  SERVO(pin);
  int steps = to_steps(servo, speed);
  if (steps > S360_MAX_SPEED) return -2;
  servo->control_limit = steps;
  return place_of(servo);
}

int servo360_setMaxSpeedEncoded(int pin, int speed) {
  SERVO(pin);
  if (speed > S360_MAX_SPEED) return 0;
  servo->speed_limit = speed;
  return place_of(servo);
}

int servo360_setMaxSpeed(int pin, int speed) {
  SERVO(pin);
  return servo360_setMaxSpeedEncoded(pin, to_steps(servo, speed));
}

int servo360_setUnitsFullCircle(int pin, int units) {
  SERVO(pin);
  if (servo->units > S360_UNITS_FULL_CIRCLE) return -1;
  servo->units = units;
  return place_of(servo);
}

int servo360_setAcceleration(int pin, int unitsPerSecSquared) {
  SERVO(pin);
  servo->ramp_step = unitsPerSecSquared * S360_UNITS_ENCODER / (S360_CS_HZ * servo->units);
  return place_of(servo);
}

int servo360_getAcceleration(int pin) {
  SERVO(pin);
  return servo->ramp_step * (S360_CS_HZ * servo->units) / S360_UNITS_ENCODER;
}

static volatile int *setting(volatile struct servo *servo, int constant) {
  switch (constant) {
  case S360_SETTING_KPV: return &servo->kp_v;
  case S360_SETTING_KIV: return &servo->ki_v;
  case S360_SETTING_KDV: return &servo->kd_v;
  case S360_SETTING_IV_MAX: return &servo->most_integral_v;
  case S360_SETTING_KPA: return &servo->kp;
  case S360_SETTING_KIA: return &servo->ki;
  case S360_SETTING_KDA: return &servo->kd;
  case S360_SETTING_IA_MAX: return &servo->most_integral;
  case S360_SETTING_VM_CCW: return &servo->m_ccw;
  case S360_SETTING_VM_CW: return &servo->m_cw;
  case S360_SETTING_VB_CCW: return &servo->b_ccw;
  case S360_SETTING_VB_CW: return &servo->b_cw;
  }
  return 0;
}

static int set(int pin, int constant, int value, int first, int last) {
  SERVO(pin);
  volatile int *place = setting(servo, constant);
  if (place && constant >= first && constant <= last) *place = value;
  return place_of(servo);
}

int servo360_setControlSys(int pin, int constant, int value) { return set(pin, constant, value, S360_SETTING_KPV, S360_SETTING_IA_MAX); }
int servo360_setTransferFunction(int pin, int constant, int value) { return set(pin, constant, value, S360_SETTING_VB_CCW, S360_SETTING_VM_CW); }

int servo360_getControlSys(int pin, int constant) {
  SERVO(pin);
  volatile int *place = setting(servo, constant);
  return place ? *place : 0;
}

#define ASK(name, answer) int servo360_##name(int pin) { SERVO(pin); return answer; }
#define TELL(name, change) int servo360_##name(int pin, int value) { SERVO(pin); change; return place_of(servo); }

ASK(getAngle, to_units(servo, servo->angle))
ASK(getAngle12Bit, servo->angle)
ASK(getAngleFixedOrigin, servo->theta)
ASK(getAngleCalc, to_units(servo, servo->calculated))
ASK(getAngleOffset, to_units(servo, servo->offset))
ASK(getSpeed, to_units(servo, servo->measured_speed))
ASK(getTurns, servo->turns)
ASK(getCsop, servo->mode)
ASK(getMaxSpeed, to_units(servo, servo->speed_limit))
ASK(getTopSpeed, servo->speed_limit)
ASK(getRampStep, servo->ramp_step)
ASK(getUnitsFullCircle, servo->units)
ASK(getAngleCtrlSpeedMax, to_units(servo, servo->control_limit))
TELL(setRampStep, servo->ramp_step = value)
TELL(setAngleOffset, servo->offset = to_steps(servo, value))
TELL(setAngleCalc, servo->calculated = to_steps(servo, value))

void servo360_monitorRun(void) {}  /* left out of the library as it is shipped */
void servo360_monitorEnd(void) {}
