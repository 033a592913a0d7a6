/* What the parts of the simulated chip share: cogs, their registers, and the records that go to the other end of the pipe. */
#ifndef ROBOSMI_CHIP_H
#define ROBOSMI_CHIP_H
#include "host.h"

enum { COGS = 8, PINS = 32, CHANNELS = 32 };

struct counter {
  unsigned control, frequency, phase;  /* as the program has written them */
  host_time since;                     /* the phase is that of this time */
  host_time toggles;                   /* when its output changes next */
  int level;                           /* its output */
  int announced, announced_pin;        /* what was told of its wave, 0 for none, and at which pin */
};

struct cog {
  int used;
  int asleep;                          /* main has ended in it: nothing more runs there, and its outputs stay */
  int of_program;                      /* it runs code of the user, whose costs varied runs change */
  host_time now;
  unsigned registers[HOST_REGISTERS];  /* what the program reads and writes */
  unsigned out, dir;                   /* what of it has taken effect */
  unsigned phase_shown[2];
  struct counter counter[2];
  unsigned wait_mask, wait_state;      /* waits for pins when the mask is not 0 */
  int wait_equal, wait_console;
  void *context;                       /* its stack pointer while it does not run */
  void (*function)(void *);
  void *parameter;
};

extern struct cog cogs[COGS];
extern int running;                    /* number of the cog that runs */
extern host_time horizon, next_wake;   /* the end of the run; when the world acts next */

/* cogs.c */
void cogs_begin(void (*function)(void *));
int cogs_started(void);                /* whether the program runs */
void cogs_reschedule(void);            /* another cog may have to run before this one goes on */
void cogs_look(void);                  /* something may have to happen earlier than was planned */
void cogs_wake(struct cog *cog, host_time when);
host_time vary(host_time ticks, double factor);
void tell_call(void *const *frame, int prints);  /* the call of the program that is under way, from the frame of the function that asks */
void tell_place(const char *place, void *const *frame);

/* pins.c */
void pins_commit(void);                /* let what the running cog has written take effect */
void pins_update(host_time when);      /* work out the levels anew */
void pins_cog_stopped(struct cog *cog);
host_time pins_next(void);             /* when a counter's output changes next */
void pins_advance(host_time when);     /* let counters toggle at that time */
void pins_outside(int pin, int level, host_time when);          /* the world drives a pin; what it said ahead of it is void */
void pins_outside_ahead(int pin, int level, host_time due);     /* the world will drive a pin then */
host_time pins_ahead(void);            /* when it does so next */
void pins_reach(host_time when);       /* let it do so at that time */
void pins_contact(int pin, int other, int closed, host_time when);
void pins_decay(int pin, double from_us, double lasts_us);      /* a capacitor is there, whose charge lasts so long from then on */
void pins_pull(int pin, int up, host_time when);                /* a resistor holds a pin high that nobody drives, or none does */
unsigned pins_levels(void);

/* link.c */
enum record { RECORD_PIN = 1, RECORD_WAVE, RECORD_CONSOLE, RECORD_SYNC, RECORD_BUS_START, RECORD_BUS_WRITE, RECORD_BUS_READ,
              RECORD_BUS_STOP, RECORD_END, RECORD_CALL, RECORD_AIM, RECORD_COMPARED };
extern unsigned watched;               /* pins at which a device is */
extern unsigned asking[3];             /* pins at which one has to be told at once: of 0, of 1, of not driven any more */
extern unsigned brief;                 /* pins of which only the first change to each level is told */
extern struct settings { unsigned block_ticks, call_ticks; double noise, late_us, early_part, line_part, clock_us; host_time calls_from; } settings;
void link_open(void);
void link_record(host_time when, enum record kind, unsigned a, unsigned b, unsigned c);
int link_sync(host_time when, enum record kind, unsigned a, unsigned b);  /* tell, and do what the world answers; its value */
double link_noise(void);               /* from -1 to 1 */

/* compared.c */
void compared_tell(host_time when);     /* a record for each comparison that the program has made */

/* guard.c */
void guard_begin(void);
unsigned *guard_stack_top(int number);
int guard_on_stack(int number, const void *where);
#endif
