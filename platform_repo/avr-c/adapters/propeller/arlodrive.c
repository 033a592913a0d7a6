//# header arlodrive.h
// The drive of the Arlo in C: texts to a motor controller DHB-10 on one line, and its answers. Read from Simple-Libraries 1cc167c10,
// Learn/Simple Libraries/Robotics/Arlo/libarlodrive (arlodrive.h, arlodrive.c, drive_*.c). There a cog sends and receives; here the
// program does, with interrupts off for each byte.

//# constant SIDE_TERM
//#   fidelity: exact
#define SIDE_TERM 0

//# constant DHB10_LEN
//#   fidelity: exact
#define DHB10_LEN 64

//# constant ARD_MODE_VERBOSE
//#   fidelity: exact
#define ARD_MODE_VERBOSE 1

//# constant ARD_MODE_CONCISE
//#   fidelity: exact
#define ARD_MODE_CONCISE 0

//# helper arlo_pin
//#   port: arlo_line = arlodrive.line 12 digital both motor-controller
//#   ram: 1
static uint8_t arlo_pin;

__attribute__((constructor, used)) static void arlo_usual_pin(void) { arlo_pin = arlo_line; }

//# helper half_duplex
//#   needs: simpletools.h/Io
//#   include: <avr/interrupt.h> <util/delay_basic.h>
//#   fidelity: 19,200 baud both ways on one line that a pull-up holds high
static inline void half_release(Io io) {
  io_put(io, IO_DIRECTION, false);
  io_put(io, IO_OUT, true);
}

static inline void half_hold(uint8_t part) { _delay_loop_2(part - 6); }  // units of 4 cycles; 6 for what stands around it

enum { half_bit = F_CPU / 19200 / 4 };

static void half_send(Io io, uint8_t byte) {
  if (!io.mask) return;
  uint8_t old = SREG;
  cli();
  for (uint16_t bits = byte << 1 | 0x200, left = 10; left; left--, bits >>= 1) {
    if (bits & 1) {
      half_release(io);
    } else {
      io_put(io, IO_OUT, false);
      io_put(io, IO_DIRECTION, true);
    }
    half_hold(half_bit - 4);
  }
  SREG = old;
}

static uint8_t half_receive(Io io) {  // right after the start bit began
  uint8_t old = SREG, byte = 0;
  cli();
  half_hold(half_bit / 2);
  for (uint8_t number = 0; number < 8; number++) {
    half_hold(half_bit);
    byte = byte >> 1 | (io_high(io) ? 0x80 : 0);
  }
  half_hold(half_bit);
  SREG = old;
  return byte;
}

//# helper arlo_command
//#   needs: arlo_pin half_duplex DHB10_LEN propeller.h/clock_us
//#   include: <stdlib.h> <string.h>
//#   fidelity: up to a second for an answer, as there; nothing else runs while it waits
//#   ram: 64
static char arlo_reply[DHB10_LEN];

static inline char *arlo_command(const char *text) {
  memset(arlo_reply, 0, DHB10_LEN);
  Io line = io_at(arlo_pin);
  if (line.mask) half_release(line);
  uint8_t length = 0;
  do half_send(line, text[length]);
  while (text[length] && text[length++] != '\r');
  if (length == 1 && *text == '\r') return 0;
  uint8_t count = 0;
  for (uint32_t begun = clock_us(); clock_us() - begun <= 1000000UL;) {
    if (!line.mask || io_high(line)) continue;
    char byte = half_receive(line);
    if (count < DHB10_LEN - 1) arlo_reply[count++] = byte;
    if (byte == '\r') return arlo_reply;
  }
  return strcpy(arlo_reply, "Error, no reply from DHB-10!\n");
}

//# helper arlo_on
//#   ram: 1
static bool arlo_on;

//# adapter drive_open
//#   for: char *drive_open(void)
//#   kind: semantic
//#   needs: arlo_on arlo_command propeller.h/clock_wait
//#   role: motor-controller
//#   fidelity: exact: half a second of waiting, then "verb 1" and its answer; 1 s more and a text that says so without one
//#   limit: while a byte is sent or received interrupts are off for 0.5 ms, and other cogs wait for an answer
static inline char *drive_open(void) {
  arlo_on = true;
  clock_wait(510);
  arlo_command("\r");
  return arlo_command("verb 1\r");
}

//# adapter dhb10_com
//#   for: char *dhb10_com(char *configStr)
//#   kind: semantic
//#   needs: arlo_on arlo_command drive_open
//#   role: motor-controller
//#   fidelity: exact: the text up to a carriage return, and the answer up to one, of 63 characters at most; 0 for a carriage return alone
static inline char *dhb10_com(const char *configStr) {
  if (!arlo_on) drive_open();
  return arlo_command(configStr);
}

//# helper arlo
//#   fidelity: what the library keeps of the drive
//#   ram: 21
static struct {
  int32_t left, right;  // speeds asked for last
  int16_t top, step;    // the speed limit; 4 encoder ticks/s each 20 ms
  bool open_loop, block_speed, blocked_before, ramp, ramp_before;
  uint32_t stepped;     // when drive_rampStep was called last
} arlo = {0, 0, 200, 25, false, false, false, false, false, 0};

//# helper arlo_pair
//#   needs: dhb10_com simpletext.h/sscan
static inline char *arlo_pair(const char *command, int32_t *left, int32_t *right) {
  char *reply = dhb10_com(command);
  sscan(reply, "%d%d", left, right);
  return reply;
}

//# helper arlo_within
static inline int32_t arlo_within(int32_t value, int32_t least, int32_t most) {
  return value < least ? least : value > most ? most : value;
}

//# adapter drive_getSpeed
//#   for: char *drive_getSpeed(int *left, int *right)
//#   kind: oneToMany
//#   needs: arlo_pair
//#   role: motor-controller
//#   fidelity: exact: encoder ticks/s as the controller measures them; the answer as a text
#define drive_getSpeed(left, right) \
  ({ \
    int32_t left_ = *(left), right_ = *(right); \
    char *reply_ = arlo_pair("spd\r", &left_, &right_); \
    *(left) = left_; \
    *(right) = right_; \
    reply_; \
  })

//# adapter drive_getTicks
//#   for: char *drive_getTicks(int *left, int *right)
//#   kind: oneToMany
//#   needs: arlo_pair
//#   role: motor-controller
//#   fidelity: exact: encoder ticks as the controller counts them; the answer as a text
#define drive_getTicks(left, right) \
  ({ \
    int32_t left_ = *(left), right_ = *(right); \
    char *reply_ = arlo_pair("dist\r", &left_, &right_); \
    *(left) = left_; \
    *(right) = right_; \
    reply_; \
  })

//# adapter drive_speed
//#   for: char *drive_speed(int left, int right)
//#   kind: oneToMany
//#   needs: arlo arlo_on arlo_command arlo_within drive_open drive_getSpeed propeller.h/clock_wait simpletext.h/sprint
//#   role: motor-controller
//#   fidelity: exact: "gospd" when a speed has changed, without feedback "go" each time, "acc" when ramps begin or end; it waits for the speed
//#   fidelity: only after drive_speedBlocking
static inline char *drive_speed(int32_t left, int32_t right) {
  if (!arlo_on) drive_open();
  char text[40], *reply = 0;
  const int32_t asked[2] = {left, right};
  int32_t before[2] = {0, 0}, now[2] = {0, 0};
  if (arlo.block_speed) {
    clock_wait(20);
    drive_getSpeed(before, before + 1);
  }
  left = arlo_within(left, -arlo.top, arlo.top);
  right = arlo_within(right, -arlo.top, arlo.top);
  if (arlo.ramp != arlo.ramp_before) {
    sprint(text, "acc %d\r", arlo.ramp ? arlo.step : 512);
    reply = arlo_command(text);
  }
  bool changed = arlo.left != left || arlo.right != right;
  if (arlo.open_loop || (changed && !(arlo.ramp && arlo.ramp_before))) {
    sprint(text, arlo.open_loop ? "go %d %d\r" : "gospd %d %d\r", left, right);
    reply = arlo_command(text);
  }
  if (arlo.block_speed) {
    drive_getSpeed(now, now + 1);
    for (uint8_t there = 0, still = 0; there < 3 && still < 6; clock_wait(20)) {
      drive_getSpeed(now, now + 1);
      if (labs(asked[0] - now[0]) <= 6 && labs(asked[1] - now[1]) <= 6) there++;
      else if (labs(now[0] - before[0]) <= 1 && labs(now[1] - before[1]) <= 1) still++;
      else there = still = 0;
      before[0] = now[0];
      before[1] = now[1];
    }
  }
  arlo.left = left;
  arlo.right = right;
  arlo.ramp_before = arlo.ramp;
  arlo.ramp = false;
  return reply;
}

//# helper arlo_goto
//#   fidelity: so many times 20 ms at rest end drive_goto
//#   ram: 4
static int32_t arlo_goto = 16;

//# adapter drive_gotoDoneDelay
//#   for: void drive_gotoDoneDelay(int msTillDoneApprox)
//#   kind: oneToOne
//#   needs: arlo_goto
//#   fidelity: exact: in units of 20 ms, whatever the name of the parameter says
static inline void drive_gotoDoneDelay(int32_t msTillDoneApprox) {
  arlo_goto = msTillDoneApprox;
}

//# adapter drive_goto
//#   for: char *drive_goto(int distLeft, int distRight)
//#   kind: oneToMany
//#   needs: arlo arlo_goto dhb10_com drive_getTicks propeller.h/clock_wait simpletext.h/sprint
//#   role: motor-controller
//#   fidelity: exact: it returns when the wheels are there, or rest, for some 16 times 20 ms
static inline char *drive_goto(int32_t distLeft, int32_t distRight) {
  char text[48];
  int32_t to[2], before[2], now[2] = {0, 0};
  clock_wait(20);
  drive_getTicks(now, now + 1);
  for (uint8_t side = 0; side < 2; side++) to[side] = (before[side] = now[side]) + (side ? distRight : distLeft);
  sprint(text, "move %d %d %d\r", distLeft, distRight, arlo.top);
  char *reply = dhb10_com(text);
  for (int32_t there = 0, still = 0; there < arlo_goto && still < arlo_goto; clock_wait(20)) {
    drive_getTicks(now, now + 1);
    if (labs(to[0] - now[0]) <= 1 && labs(to[1] - now[1]) <= 1) there++;
    else if (labs(now[0] - before[0]) <= 1 && labs(now[1] - before[1]) <= 1) still++;
    else there = still = 0;
    before[0] = now[0];
    before[1] = now[1];
  }
  return reply;
}

//# adapter drive_rampStep
//#   for: void drive_rampStep(int left, int right)
//#   kind: semantic
//#   needs: arlo arlo_on arlo_within drive_open drive_speed propeller.h/clock_ms
//#   role: motor-controller
//#   fidelity: exact: 50 ms after the call before at the earliest; with feedback the controller makes the ramp, and only the first of several
//#   fidelity: calls says a speed, as there
static inline void drive_rampStep(int32_t left, int32_t right) {
  if (!arlo_on) drive_open();
  while (clock_ms() - arlo.stepped < 50) {}
  arlo.stepped = clock_ms();
  int32_t step = arlo.step * 4 / 20;
  if (arlo.open_loop) {
    left = arlo_within(left, arlo.left - step, arlo.left + step);
    right = arlo_within(right, arlo.right - step, arlo.right + step);
  }
  arlo.ramp = true;
  drive_speed(left, right);
}

//# adapter drive_ramp
//#   for: void drive_ramp(int left, int right)
//#   kind: oneToMany
//#   needs: arlo arlo_on drive_open drive_rampStep
//#   role: motor-controller
//#   fidelity: exact; a speed above the limit is never reached, and it does not return, as there
static inline void drive_ramp(int32_t left, int32_t right) {
  if (!arlo_on) drive_open();
  while (arlo.left != left || arlo.right != right) drive_rampStep(left, right);
}

//# adapter drive_clearTicks
//#   for: char *drive_clearTicks(void)
//#   kind: oneToOne
//#   needs: dhb10_com
//#   role: motor-controller
//#   fidelity: exact
static inline char *drive_clearTicks(void) {
  return dhb10_com("rst\r");
}

//# adapter drive_setRampStep
//#   for: void drive_setRampStep(int stepsize)
//#   kind: oneToOne
//#   needs: arlo arlo_on drive_open
//#   role: motor-controller
//#   fidelity: exact: a quarter of it is said to the controller
static inline void drive_setRampStep(int32_t stepsize) {
  if (!arlo_on) drive_open();
  arlo.step = stepsize / 4;
}

//# adapter drive_setMaxSpeed
//#   for: void drive_setMaxSpeed(int speed)
//#   kind: oneToOne
//#   needs: arlo arlo_on drive_open
//#   role: motor-controller
//#   fidelity: exact
static inline void drive_setMaxSpeed(int32_t speed) {
  if (!arlo_on) drive_open();
  arlo.top = speed;
}

//# adapter drive_feedback
//#   for: void drive_feedback(int enabled)
//#   kind: oneToOne
//#   needs: arlo arlo_on drive_open
//#   role: motor-controller
//#   fidelity: exact: without it drive_speed says powers and does not wait for speeds
static inline void drive_feedback(int32_t enabled) {
  if (!arlo_on) drive_open();
  arlo.open_loop = !enabled;
  if (!enabled) arlo.blocked_before = arlo.block_speed;
  arlo.block_speed = enabled && arlo.blocked_before;
}

//# adapter drive_speedBlocking
//#   for: void drive_speedBlocking(int enabled)
//#   kind: oneToOne
//#   needs: arlo arlo_on drive_open
//#   role: motor-controller
//#   fidelity: exact
static inline void drive_speedBlocking(int32_t enabled) {
  if (!arlo_on) drive_open();
  arlo.block_speed = enabled;
}

//# adapter drive_close
//#   for: void drive_close(void)
//#   kind: oneToMany
//#   needs: arlo_on arlo_pin drive_speedBlocking drive_speed simpletools.h/Io
//#   role: motor-controller
//#   fidelity: exact: the wheels stand, and the pin is an input
static inline void drive_close(void) {
  drive_speedBlocking(1);
  drive_speed(0, 0);
  io_drive(io_at(arlo_pin), false);
  arlo_on = false;
}

//# adapter drive_servoPins
//#   for: void drive_servoPins(int servoPinLeft, int servoPinRight)
//#   kind: oneToMany
//#   needs: arlo_on arlo_pin drive_open drive_close
//#   role: motor-controller
//#   pin: servoPinLeft digital both motor-controller
//#   pin: servoPinRight digital both
//#   fidelity: exact: the line is at the first pin, the second is not used, as there
static inline void drive_servoPins(int32_t servoPinLeft, int32_t servoPinRight) {
  (void)servoPinRight;
  if (arlo_on) drive_close();
  arlo_pin = servoPinLeft;
  drive_open();
}
