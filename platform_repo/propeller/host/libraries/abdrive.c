/* abdrive.h: the drive of the ActivityBot, two continuous servos with encoders of 64 ticks a turn. A cog works in frames of 20 ms: a ramp,
 * the wheel with the smaller change slower, no pulses and five frames of rest at a stand. Pulses are those of the commanded speeds: the
 * correction by the encoders and the table of a calibration are not modelled; 128 ticks/s are 200 us beyond neutral.
 * Sources: libabdrive (abdrive.c, speed.c, goto.c, ramp.c, setAcceleration.c and their neighbours). */
#include "abdrive.h"

enum { FRAME_TICKS = 20 * HOST_TICKS_PER_MS, SAMPLE_TICKS = HOST_HZ / 800, SETTINGS = 63418 + 12 };

static struct wheel {
  volatile int speed, wanted, step, limit;    /* ticks/s; step: at most so much more each frame */
  volatile int finer, finer_sum, finer_now;   /* 1/50 of the step that whole numbers lose, carried over frames */
  volatile int speed_finer, speed_sum;        /* the same for the top speed of drive_goto */
  volatile int rest;                          /* frames left at a stand */
  volatile int going;                         /* drive_goto: 0 there, 1 on the way, 2 coming to a stand, 3 making up for ticks */
  int guard;                                  /* so many ticks before the end it stops; at a stand what it was at the last speed */
  volatile int ticks, goal;
  volatile int calculated;                    /* ticks as the speeds make them, in 1/800 */
  int sense, level, seen, servo, encoder;
} wheels[2];
static volatile unsigned frames_done;
static volatile int corrects = 1, most_ahead = 10;  /* calculated ticks stay that near to those of the encoders */
static volatile int speed_limit = ABD_SPEED_LIMIT, ramp_step = ABD_RAMP_STEP, goto_step = ABD_GOTO_RAMP_STEP, goto_waits = 1;
static int drive_cog, ready, last[2], aim = -1;

static int magnitude(int value) { return value < 0 ? -value : value; }

static int beyond_neutral(int speed) { return speed * 25 / 16; }

static void sample(void) {
  unsigned levels = INA;
  for (int side = 0; side < 2; side++) {
    struct wheel *wheel = &wheels[side];
    int now = levels >> wheel->encoder & 1;
    if (now == wheel->seen && now != wheel->level) {
      wheel->level = now;
      wheel->ticks += wheel->sense;
    }
    wheel->seen = now;
    wheel->calculated += wheel->speed;
  }
}

static int carried(volatile int *sum, int part) {
  int before = *sum / 50;
  *sum += part;
  return *sum / 50 - before;
}

/* What drive_goto wants of a wheel in this frame. */
static void go_on(struct wheel *wheel) {
  int left = wheel->goal - wheel->ticks, more = carried(&wheel->speed_sum, wheel->speed_finer);
  if (wheel->going == 1) {
    /* a division by a step of 0 gives -1 there (propgcc, kernel.ext) */
    if (wheel->speed) wheel->guard = wheel->step ? wheel->speed * wheel->speed / (100 * wheel->step) : 1;
    if (magnitude(left) > wheel->guard + more) {
      wheel->wanted = left > 0 ? wheel->limit + more : -wheel->limit - more;
    } else {
      wheel->wanted = 0;
      wheel->going = 2;
    }
  }
  if (!wheel->rest && (wheel->going == 3 || (wheel->going == 2 && !wheel->speed))) {
    wheel->going = left ? 3 : 0;
    wheel->speed = left > 0 ? ABD_NUDGE_SPEED : left < 0 ? -ABD_NUDGE_SPEED : 0;
  }
}

static void frame(struct wheel *wheel, int counter) {
  int before = wheel->speed, more = carried(&wheel->finer_sum, wheel->finer);
  if (wheel->going) go_on(wheel);
  if (wheel->wanted > speed_limit) wheel->wanted = speed_limit;
  if (wheel->wanted < -speed_limit) wheel->wanted = -speed_limit;
  if (!wheel->rest && wheel->going != 3) {
    if (wheel->wanted > wheel->speed + wheel->step) wheel->speed += wheel->step + more;
    else if (wheel->wanted < wheel->speed - wheel->step) wheel->speed -= wheel->step + more;
    else wheel->speed = wheel->wanted;
  }
  int speed = wheel->speed, us_high = counter ? 1500 - beyond_neutral(speed) : 1500 + beyond_neutral(speed);
  if (before && !speed) wheel->rest = ABD_STOP_50ths;
  if (speed) wheel->sense = speed > 0 ? 1 : -1;
  *host_register(HOST_PHSA + counter) = speed ? -us_high * HOST_TICKS_PER_US : 0;
  int ahead = wheel->calculated / 800 - wheel->ticks;
  if (corrects && magnitude(ahead) > most_ahead) wheel->calculated = (wheel->ticks + (ahead > 0 ? most_ahead : -most_ahead)) * 800;
  if (!speed && wheel->rest && !--wheel->rest) wheel->calculated = wheel->ticks * 800;
}

/* Two neutral pulses 20 ms apart, then a frame every 20 ms, and the encoders 800 times a second. */
static void drive(void *unused) {
  (void)unused;
  for (int side = 0; side < 2; side++) {
    OUTA &= ~(1u << wheels[side].servo);
    DIRA |= 1u << wheels[side].servo;
  }
  host_sleep_until(host_now() + FRAME_TICKS);
  host_time next = host_now(), next_sample;
  for (int turn = 0; turn < 2; turn++) {
    for (int side = 0; side < 2; side++) {
      *host_register(HOST_FRQA + side) = 1;
      *host_register(HOST_CTRA + side) = 4u << 26 | wheels[side].servo;
      *host_register(HOST_PHSA + side) = -1500 * HOST_TICKS_PER_US;
    }
    if (!turn) frames_done++;
    host_sleep_until(next += FRAME_TICKS);
  }
  unsigned levels = INA;
  for (int side = 0; side < 2; side++) wheels[side].level = wheels[side].seen = levels >> wheels[side].encoder & 1;
  for (next_sample = next;;) {
    for (int side = 0; side < 2; side++) frame(&wheels[side], side);
    frames_done++;
    for (next += FRAME_TICKS; next_sample < next; next_sample += SAMPLE_TICKS) {
      if (next_sample > host_now()) host_spend(next_sample - host_now());
      sample();
    }
    if (next > host_now()) host_spend(next - host_now());
  }
}

static void read_pins(void) {
  unsigned char kept[16];
  ee_getStr(kept, 16, SETTINGS);
  const unsigned char *servo = kept, *encoder = kept + 8;
  int own_servos = servo[0] == 's' && servo[1] == 'p' && servo[2] == 'L' && servo[5] == 'R';
  int own_encoders = encoder[0] == 'e' && encoder[1] == 'p' && encoder[2] == 'L' && encoder[5] == 'R';
  for (int side = 0; side < 2; side++) {
    wheels[side].servo = (own_servos ? servo[3 + 3 * side] : 12 + side) & 31;
    wheels[side].encoder = (own_encoders ? encoder[3 + 3 * side] : 14 + side) & 31;
    wheels[side].sense = 1;
  }
}

static void aims(int now) {
  if (now != aim)
    for (int side = 0; side < 2; side++) host_aims(wheels[side].servo, now);
  aim = now;
}

static void wait_for_rest(void) {
  while (wheels[0].rest || wheels[1].rest) host_call();
}

static void wait_frames(unsigned count) {
  for (unsigned until = frames_done + count; frames_done != until;) host_call();
}

static void head_for(int left, int right) {
  int wanted[2] = {left, right}, change[2];
  aims(HOST_FOR_A_TIME);
  for (int side = 0; side < 2; side++) {
    struct wheel *wheel = &wheels[side];
    wheel->wanted = wanted[side];
    wheel->finer = wheel->finer_sum = wheel->speed_finer = wheel->speed_sum = 0;
    wheel->going = 0;
    wheel->limit = speed_limit;
    change[side] = wanted[side] - wheel->speed;
  }
  for (int side = 0; side < 2; side++) {
    int most = magnitude(change[!side]), own = magnitude(change[side]);
    wheels[side].step = ramp_step;
    if (most > own) {
      wheels[side].step = ramp_step * own / most;
      wheels[side].finer = ramp_step * own % most * 50 / most;
    }
  }
  if (!drive_cog) drive_cog = host_start(drive, 0, -1) + 1;
  wait_for_rest();
  wait_frames(6);
  wait_for_rest();
}

static void start(void) {
  if (ready) return;
  ready = 1;
  read_pins();
  head_for(0, 0);
}

void drive_speed(int left, int right) {
  host_call();
  start();
  if (left != last[0] || right != last[1]) head_for(left, right);
  last[0] = wheels[0].wanted;
  last[1] = wheels[1].wanted;
}

void drive_rampStep(int left, int right) { drive_speed(left, right); }

void drive_ramp(int left, int right) {
  drive_speed(left, right);
  while (magnitude(wheels[0].speed - left) >= 4 && magnitude(wheels[1].speed - right) >= 4) pause(20);
}

static int on_the_way(void) { return wheels[0].going || wheels[1].going || wheels[0].rest > 0 || wheels[1].rest > 0; }

void drive_goto(int distLeft, int distRight) {
  int way[2] = {distLeft, distRight}, limit_before = speed_limit;
  host_call();
  if (wheels[0].wanted || wheels[1].wanted) drive_speed(0, 0);
  start();
  aims(HOST_BY_A_WAY);
  speed_limit = ABD_GOTO_SPEED_LIMIT;
  for (int side = 0; side < 2; side++) {
    struct wheel *wheel = &wheels[side];
    int own = magnitude(way[side]), most = magnitude(way[!side]);
    if (magnitude(wheel->goal - wheel->ticks) >= 6) wheel->goal = wheel->ticks;  /* small misses are made up for */
    wheel->goal += way[side];
    wheel->limit = ABD_GOTO_SPEED_LIMIT;
    wheel->step = goto_step;
    wheel->finer = wheel->finer_sum = wheel->speed_finer = wheel->speed_sum = 0;
    if (most > own) {
      wheel->limit = ABD_GOTO_SPEED_LIMIT * own / most;
      wheel->speed_finer = ABD_GOTO_SPEED_LIMIT * own % most * 50 / most;
      wheel->step = goto_step * own / most;
      wheel->finer = goto_step * own % most * 50 / most;
    }
    wheel->going = 1;
  }
  last[0] = last[1] = 0;
  if (goto_waits == 1) {
    while (on_the_way()) host_call();
    pause(40);
    while (on_the_way()) host_call();
  }
  speed_limit = limit_before;
}

void drive_getTicks(int *left, int *right) {
  host_call();
  *left = wheels[0].ticks;
  *right = wheels[1].ticks;
}

void drive_getTicksCalc(int *left, int *right) {
  host_call();
  *left = wheels[0].calculated / 800;
  *right = wheels[1].calculated / 800;
}

void drive_gotoMode(int mode) { goto_waits = mode; }

int drive_gotoStatus(int side) {
  host_call();
  return (side == SIDE_RIGHT ? 0 : wheels[0].going) + (side == SIDE_LEFT ? 0 : wheels[1].going);
}

void drive_setMaxSpeed(int speed) { speed_limit = speed; }

void drive_setMaxVelocity(int forGotoOrSpeed, int ticksPerSec) {
  if (forGotoOrSpeed == FOR_SPEED || forGotoOrSpeed == FOR_GOTO) speed_limit = ticksPerSec;
}

void drive_setRampStep(int stepsize) { ramp_step = stepsize; }

void drive_setAcceleration(int forGotoOrSpeed, int ticksPerSecSq) {
  int step = magnitude(ticksPerSecSq) / 50;
  if (forGotoOrSpeed == FOR_SPEED) ramp_step = step;
  if (forGotoOrSpeed == FOR_SPEED || forGotoOrSpeed == FOR_GOTO) goto_step = step;
}

void drive_feedback(int enabled) { corrects = enabled; }

void drive_setErrorLimit(int maxDistDiffTicks) { most_ahead = maxDistDiffTicks; }

static void keep_pins(char kind, int left, int right, int offset) {
  unsigned char bytes[8] = {kind, 'p', 'L', (unsigned char)left, ' ', 'R', (unsigned char)right, ' '};
  ee_putStr(bytes, 8, SETTINGS + offset);
}

void drive_servoPins(int servoPinLeft, int servoPinRight) { keep_pins('s', servoPinLeft, servoPinRight, 0); }

void drive_encoderPins(int encPinLeft, int encPinRight) { keep_pins('e', encPinLeft, encPinRight, 8); }

void drive_pins(int servoPinLeft, int servoPinRight, int encPinLeft, int encPinRight) {
  drive_servoPins(servoPinLeft, servoPinRight);
  drive_encoderPins(encPinLeft, encPinRight);
}
