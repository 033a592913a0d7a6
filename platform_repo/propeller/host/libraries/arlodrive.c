/* arlodrive.h: texts to a motor controller on one line of 19,200 baud, and its answers. Sources: libarlodrive (arlodrive.c, drive_*.c). */
#include "simpletools.h"
#include "arlodrive.h"

enum { REACHED = 1, NEAR_SPEED = 6, ONE_WIRE = FDSERIAL_MODE_OPENDRAIN_TX | FDSERIAL_MODE_IGNORE_TX_ECHO };
static fdserial *line;
static char reply[DHB10_LEN];
static int opened, pin = ARD_DEFAULT_SERVO_L, feedback = 1, speed_limit = ARD_DEFAULT_SPEEDLIMIT, ramp_step = ARD_DEFAULT_RAMPSTEP;
static int speeds[2], ramping, ramped_before, goto_blocks = 1, goto_rests = ARD_DEFAULT_DONE_REPS, speed_blocks, speed_blocked_before;
static unsigned last_step;

static int magnitude(int value) { return value < 0 ? -value : value; }
static int within(int value, int limit) { return value > limit ? limit : value < -limit ? -limit : value; }

char *drive_open() {
  memset(reply, 0, DHB10_LEN);
  line = fdserial_open(pin, pin, ONE_WIRE, 19200);
  opened = 1;
  pause(10);
  dhb10_com("\r");
  return dhb10_com("verb 1\r");
}

static void need(void) {
  if (!opened) drive_open();
}

/* Sends up to a carriage return, and waits up to a second for an answer; a carriage return alone gets none. */
char *dhb10_com(char *configStr) {
  int length = 0, count = 0;
  memset(reply, 0, DHB10_LEN);
  need();
  fdserial_rxFlush(line);
  for (;; length++) {
    fdserial_txChar(line, configStr[length]);
    if (configStr[length] == '\r' || !configStr[length]) break;
  }
  if (!length && *configStr == '\r') return 0;
  for (host_time begun = host_now();;) {
    if (fdserial_rxCount(line)) {
      char c = readChar(line);
      if (count < DHB10_LEN - 1) reply[count++] = c;
      if (c == '\r') return reply;
    }
    if (host_now() - begun > HOST_HZ) return strcpy(reply, "Error, no reply from DHB-10!\n");
  }
}

static char *ask(char *command, int *left, int *right) {
  need();
  dhb10_com(command);
  sscan(reply, "%d%d", left, right);
  return reply;
}

char *drive_getTicks(int *left, int *right) { return ask("dist\r", left, right); }
char *drive_getSpeed(int *left, int *right) { return ask("spd\r", left, right); }

char *drive_clearTicks(void) {
  need();
  return dhb10_com("rst\r");
}

static int both_near(const int *a, const int *b, int distance) {
  return magnitude(a[0] - b[0]) <= distance && magnitude(a[1] - b[1]) <= distance;
}

/* Until the wheels are there, or do not change any more, so many times 20 ms in a row. */
static void wait_until(char *(*get)(int *left, int *right), const int *goal, const int *first, int distance, int there, int resting) {
  int now[2], before[2] = {first[0], first[1]}, at_goal = 0, at_rest = 0;
  while (at_goal < there && at_rest < resting) {
    get(&now[0], &now[1]);
    if (both_near(goal, now, distance)) at_goal++;
    else if (both_near(now, before, REACHED)) at_rest++;
    else at_goal = at_rest = 0;
    memcpy(before, now, sizeof before);
    pause(20);
  }
}

char *drive_speed(int left, int right) {
  char command[32];
  char *answer = reply;
  int goal[2] = {left, right}, first[2] = {0, 0};
  need();
  if (speed_blocks) {
    pause(20);
    drive_getSpeed(&first[0], &first[1]);
  }
  left = within(left, speed_limit), right = within(right, speed_limit);
  if (ramping != ramped_before) {
    sprint(command, "acc %d\r", ramping ? ramp_step : ARD_DEFAULT_ACCEL_LIMIT);
    answer = dhb10_com(command);
  }
  int changed = speeds[0] != left || speeds[1] != right;
  if (!feedback || (changed && !(ramping && ramped_before))) {
    sprint(command, feedback ? "gospd %d %d\r" : "go %d %d\r", left, right);
    answer = dhb10_com(command);
  }
  if (speed_blocks) {
    int now[2];
    drive_getSpeed(&now[0], &now[1]);
    wait_until(drive_getSpeed, goal, first, NEAR_SPEED, 3, 6);
  }
  speeds[0] = left, speeds[1] = right;
  ramped_before = ramping;
  ramping = 0;
  return answer;
}

char *drive_goto(int distLeft, int distRight) {
  char command[32];
  int first[2] = {0, 0};
  need();
  if (goto_blocks) {
    pause(20);
    drive_getTicks(&first[0], &first[1]);
  }
  sprint(command, "move %d %d %d\r", distLeft, distRight, speed_limit);
  char *answer = dhb10_com(command);
  int goal[2] = {first[0] + distLeft, first[1] + distRight};
  if (goto_blocks) wait_until(drive_getTicks, goal, first, REACHED, goto_rests, goto_rests);
  return answer;
}

void drive_rampStep(int left, int right) {
  int step = ramp_step * 4 / 20;
  need();
  while (CNT - last_step < HOST_HZ / 20) host_call();
  last_step = CNT;
  if (!feedback) {
    left = speeds[0] + within(left - speeds[0], step);
    right = speeds[1] + within(right - speeds[1], step);
  }
  ramping = 1;
  drive_speed(left, right);
}

void drive_ramp(int left, int right) {
  need();
  while (speeds[0] != left || speeds[1] != right) drive_rampStep(left, right);
}

void drive_setRampStep(int stepsize) {
  need();
  ramp_step = stepsize / 4;
}

void drive_setMaxSpeed(int speed) {
  need();
  speed_limit = speed;
}

void drive_feedback(int enabled) {
  need();
  feedback = enabled;
  if (enabled) speed_blocks = speed_blocked_before;
  else speed_blocked_before = speed_blocks, speed_blocks = 0;
}

void drive_speedBlocking(int enabled) {
  need();
  speed_blocks = enabled;
}

void drive_gotoBlocking(int enabled) {
  need();
  goto_blocks = enabled;
}

/* In units of 20 ms, whatever the parameter is called. */
void drive_gotoDoneDelay(int msTillDoneApprox) { goto_rests = msTillDoneApprox; }

void drive_close(void) {
  drive_speedBlocking(1);
  drive_speed(0, 0);
  fdserial_close(line);
  opened = 0;
}

/* The line is at the first pin, the second is not used. */
void drive_servoPins(int servoPinLeft, int servoPinRight) {
  (void)servoPinRight;
  if (opened) drive_close();
  pin = servoPinLeft;
  drive_open();
}

static void show(fdserial *terminal, int c) {
  if (c == '\r') dprint(terminal, "\\r\n");
  else if (c >= ' ' && c <= 'z') writeChar(terminal, c);
  else dprint(terminal, "<%d>", c);
}

void dhb10_terminal(fdserial *fdterm) {
  int had_terminal = simpleterm_pointer() != 0, count = 0;
  char typed[32] = "";
  if (had_terminal) simpleterm_close();
  fdserial *terminal = fdterm == SIDE_TERM ? fdserial_open(31, 30, 0, 115200) : fdterm;
  need();
  dprint(terminal, "Arlo Command Mode\n");
  dprint(terminal, "Ready\n> ");
  fdserial_rxFlush(line);
  for (;;) {
    if (fdserial_rxCount(terminal)) {
      char c = readChar(terminal);
      if (count < 31) typed[count++] = c;
      writeChar(terminal, c);
      if (c == '\n') c = '\r';
      writeChar(line, c);
      if (c == '\r') {
        int leaves = strstr(typed, "exit") || strstr(typed, "EXIT");
        memset(typed, 0, sizeof typed);
        count = 0;
        if (leaves) break;
      }
    }
    if (fdserial_rxCount(line)) show(terminal, readChar(line));
  }
  dprint(terminal, "Exit command mode.\n");
  if (fdterm == SIDE_TERM || had_terminal) fdserial_close(terminal);
  if (had_terminal) simpleterm_open();
}
