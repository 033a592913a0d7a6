"""Cogs of propeller.h, simpletools.h and sys/thread.h, and POSIX threads: coroutines that take turns when one of them waits."""

from __future__ import annotations

import itertools

import pytest

from tests.adapters.bench import Uno, proves

SLOTS = "#define COG_SLOTS {}\n#define COG_STACK {}\n"


def cogs(uno: Uno, program: str, uses: list[str], milliseconds: float = 60, slots: int = 2, stack: int = 200) -> str:
    """Run a program with cogs; returns what it prints."""
    return uno.run(program, uses, milliseconds, first=SLOTS.format(slots, stack)).text


@proves("simpletools.h/cog_run", "simpletools.h/cog_end", "simpletools.h/cog_num")
def cogs_run_beside_main_until_they_are_ended(uno: Uno) -> None:
    program = """
volatile int32_t turns;
void blinker(void *) { for (;;) { digitalWrite(8, HIGH); delay(3); digitalWrite(8, LOW); delay(7); turns++; } }
void setup() {
  Serial.begin(115200); pinMode(8, OUTPUT); pinMode(9, OUTPUT);
  int32_t *cog = cog_run(blinker, 10); int *other = cog_run(blinker, 10); int *none = cog_run(blinker, 10);
  Serial.print(cog_num(cog)); Serial.print(cog_num(other)); Serial.print(!none); Serial.print(' ');
  cog_end(other);
  for (int i = 0; i < 4; i++) { digitalWrite(9, HIGH); delay(5); digitalWrite(9, LOW); delay(6); }
  cog_end(cog); int32_t was = turns; delay(15); Serial.print(was); Serial.print(turns - was); Serial.print(*cog); cog_end(cog);
  cog = cog_run(blinker, 1); Serial.print(' '); Serial.print(cog_num(cog));
} void loop() { delay(1); }
"""
    uses = ["simpletools.h/cog_run", "simpletools.h/cog_end", "simpletools.h/cog_num"]
    trace = uno.run(program, uses, 80, first=SLOTS.format(2, 200))
    assert trace.text == "121 400 1"
    ups = [at for at, level in trace.levels("D8") if level == 1]
    assert [b - a for a, b in itertools.pairwise(ups[:4])] == [pytest.approx(10_000, abs=300)] * 3
    assert [at - ups[0] for at, level in trace.levels("D9") if level == 1][1:3] == [
        pytest.approx(11_000, abs=400), pytest.approx(22_000, abs=400),
    ]  # fmt: skip


@proves("propeller.h/cogstart", "propeller.h/cogid", "propeller.h/cogstop", "sys/thread.h/_start_cog_thread")
def cogs_know_their_numbers_and_parameters(uno: Uno) -> None:
    program = """
static int32_t stack[64]; _thread_state_t state; char said[40]; int32_t values[] = {5, 7};
void note(int32_t a) { strcat(said, a == 5 ? "5" : a == 7 ? "7" : a == 1 ? "1" : a == 2 ? "2" : a == 0 ? "0" : "?"); }
void adder(void *par) { note(*(int32_t *)par); note(cogid()); if (cogid() == 2) cogstop(cogid()); for (;;) { delay(1); } }
void setup() {
  Serial.begin(115200);
  note(cogstart(adder, &values[0], stack, sizeof stack));
  note(_start_cog_thread(stack + 64, adder, &values[1], &state));
  if (cogstart(adder, 0, stack, sizeof stack) == -1) strcat(said, "-");
  note(cogid()); delay(5); strcat(said, " ");
  note(cogstart(adder, &values[0], stack, sizeof stack)); delay(5);
  cogstop(1); note(cogstart(adder, &values[1], stack, sizeof stack)); delay(5);
  Serial.print(said);
} void loop() { }
"""
    uses = ["propeller.h/cogstart", "propeller.h/cogid", "propeller.h/cogstop", "sys/thread.h/_start_cog_thread"]
    assert cogs(uno, program, uses) == "12-0" + "5172" + " 2" + "52" + "1" + "71"


@proves("propeller.h/__builtin_propeller_cogid", "propeller.h/__builtin_propeller_cogstop")
def what_the_macros_of_cogs_stand_for_does_the_same(uno: Uno) -> None:
    program = """
static int32_t stack[64]; volatile uint32_t turns; int32_t seen = -1;
void counter(void *) { seen = __builtin_propeller_cogid(); for (;;) { delay(1); turns++; } }
void setup() { Serial.begin(115200); Serial.print(cogstart(counter, 0, stack, sizeof stack)); delay(10); Serial.print(seen);
  Serial.print(__builtin_propeller_cogid()); __builtin_propeller_cogstop(1); uint32_t was = turns; delay(10);
  Serial.print(was > 4 && was == turns); }
void loop() {}
"""
    uses = ["propeller.h/cogstart", "propeller.h/__builtin_propeller_cogid", "propeller.h/__builtin_propeller_cogstop"]
    assert cogs(uno, program, uses) == "1101"


@proves()
def a_cog_that_needs_more_than_its_stack_stops_the_program_and_says_so(uno: Uno) -> None:
    program = """
volatile uint8_t depth; uint16_t deepest;
uint16_t dig(uint8_t left) {
  volatile uint8_t room[20]; room[0] = left; yield(); return left ? dig(left - 1) + room[0] : 0; }
void digger(void *) { for (;;) { deepest = dig(depth++); delay(1); } }
void setup() { Serial.begin(115200); cogstart(digger, 0, 0, 0);
  for (uint8_t i = 0; i < 20; i++) { delay(1); if (i == 2) { Serial.print(cog_stack_used(1) < 170); Serial.print(' '); } }
  Serial.print("not reached"); } void loop() { }
"""
    said = cogs(uno, program, ["propeller.h/cogstart", "propeller.h/cog_stack_used"])
    assert said == "1 \r\ncog 1: more stack than COG_STACK\r\n"


THREADS = [f"pthread.h/pthread_{name}" for name in ("create", "join", "exit", "self", "detach", "yield")]


@proves(*THREADS)
def threads_are_joined_with_what_they_give_back(uno: Uno) -> None:
    program = """
pthread_t one, two, three; char said[40];
void *twice(void *arg) { for (uint8_t i = 0; i < 3; i++) { strcat(said, (char *)arg); delay(2); } return (char *)arg + 1; }
void *leaves(void *arg) { strcat(said, "x"); pthread_yield(); pthread_exit(pthread_self() == two ? arg : 0); return 0; }
void *alone(void *) { pthread_detach(pthread_self()); strcat(said, "d"); return 0; }
void *turns(void *arg) { strcat(said, (char *)arg); pthread_yield(); strcat(said, (char *)arg); return 0; }
void setup() {
  Serial.begin(115200); static char a[] = "ab", b[] = "cd"; void *result = 0; void *other = 0;
  int32_t r = pthread_create(&one, NULL, twice, a) + pthread_create(&two, NULL, leaves, b);
  Serial.print(r); Serial.print(' '); Serial.print(pthread_create(&three, NULL, twice, a)); Serial.print(' ');
  r = pthread_join(one, &result) + pthread_join(two, &other);
  Serial.print(said); Serial.print(r); Serial.print(result == a + 1); Serial.print(other == b); said[0] = 0;
  Serial.print(pthread_create(&three, NULL, alone, b)); delay(3); Serial.print(said); Serial.print(pthread_join(three, &other));
  Serial.print(pthread_create(&three, NULL, alone, b)); delay(2); Serial.print(pthread_create(&three, NULL, alone, b));
  delay(3); said[0] = 0; pthread_create(&one, NULL, turns, a); pthread_create(&two, NULL, turns, b); pthread_join(one, &other);
  pthread_join(two, &other); Serial.print(said);
} void loop() { }
"""
    assert cogs(uno, program, THREADS) == "0 11 " + "abxabab" + "011" + "0d22" + "00" + "abcdabcd"


LOCKS = [f"pthread.h/pthread_mutex_{name}" for name in ("init", "lock", "trylock", "unlock", "destroy")]
CONDITIONS = [f"pthread.h/pthread_cond_{name}" for name in ("init", "wait", "signal", "broadcast", "destroy")]
ATTRIBUTES = [f"pthread.h/pthread_attr_{name}" for name in ("init", "setstacksize", "setdetachstate", "destroy")]


@proves(*LOCKS, *CONDITIONS, *ATTRIBUTES)
def threads_share_locks_and_conditions(uno: Uno) -> None:
    program = """
pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER; pthread_cond_t ready; pthread_t one, two; pthread_attr_t kind;
int32_t tokens; char said[40];
void *taker(void *arg) {
  for (;;) {
    pthread_mutex_lock(&lock);
    while (!tokens) pthread_cond_wait(&ready, &lock);
    tokens--; strcat(said, (char *)arg); delay(1);
    pthread_mutex_unlock(&lock); }
  return 0; }
void setup() {
  Serial.begin(115200); static char a[] = "a", b[] = "b";
  lock.locked = 7; Serial.print(pthread_mutex_init(&lock, NULL)); ready.woken = 9;
  Serial.print(pthread_cond_init(&ready, NULL)); Serial.print(ready.woken);
  kind.stksiz = 1; pthread_attr_init(&kind); Serial.print(kind.stksiz);
  pthread_attr_setstacksize(&kind, 80); Serial.print(kind.stksiz);
  pthread_attr_setdetachstate(&kind, PTHREAD_CREATE_DETACHED);
  pthread_create(&one, &kind, taker, a); pthread_create(&two, NULL, taker, b); Serial.print(pthread_join(one, 0));
  pthread_attr_destroy(&kind); Serial.print(kind.stksiz); Serial.print(' ');
  delay(2); Serial.print(pthread_cond_destroy(&ready));
  Serial.print(pthread_mutex_trylock(&lock)); Serial.print(pthread_mutex_trylock(&lock));
  Serial.print(pthread_mutex_destroy(&lock));
  tokens = 1; pthread_cond_signal(&ready); delay(3); Serial.print(said);
  pthread_mutex_unlock(&lock); delay(6); Serial.print(said);
  said[0] = 0; Serial.print(' '); pthread_mutex_lock(&lock);
  tokens = 2; pthread_cond_broadcast(&ready); pthread_mutex_unlock(&lock); delay(6);
  Serial.print(strlen(said)); Serial.print(pthread_mutex_destroy(&lock)); Serial.print(tokens);
} void loop() { }
"""
    uses = [*LOCKS, *CONDITIONS, *ATTRIBUTES, "pthread.h/pthread_create", "pthread.h/pthread_join",
            "pthread.h/PTHREAD_MUTEX_INITIALIZER", "pthread.h/PTHREAD_CREATE_DETACHED"]  # fmt: skip
    assert cogs(uno, program, uses) == "00051280220 1601616a 200"


@proves("pthread.h/pthread_create", beside=["pthread.h/pthread_set_affinity_thiscog_np"])
def a_thread_stays_on_its_cog(uno: Uno) -> None:
    program = """
pthread_t one; int32_t before, behind;
void *stays(void *) { before = cogid(); pthread_set_affinity_thiscog_np(); delay(2); behind = cogid(); return 0; }
void setup() { Serial.begin(115200); pthread_create(&one, NULL, stays, 0); delay(8); Serial.print(before); Serial.print(behind); }
void loop() { }
"""
    uses = ["pthread.h/pthread_create", "pthread.h/pthread_set_affinity_thiscog_np", "propeller.h/cogid"]
    assert cogs(uno, program, uses) == "11"


@proves("simpletools.h/cog_end", "propeller.h/cogstop", "simpletools.h/cog_run", "propeller.h/cogstart")
def pins_of_a_cog_that_ends_are_let_go(uno: Uno) -> None:
    """A pin that main drives, too, stays an output; one of an ended, stopped or returning cog floats, as on the Propeller."""
    program = """
static int32_t stack[64];
void pump(void *) { high(7); high(8); for (;;) delay(1); }
void lamp(void *) { high(6); delay(2); }
void setup() {
  Serial.begin(115200); high(8);
  int32_t *cog = cog_run(pump, 10); int32_t other = cogstart(lamp, 0, stack, sizeof stack); delay(1);
  Serial.print(DDRD >> 6 & 3); Serial.print(DDRB & 1); delay(5);
  Serial.print(DDRD >> 6 & 3); cog_end(cog); Serial.print(DDRD >> 6 & 3); Serial.print(PORTD >> 6 & 3);
  Serial.print(DDRB & 1); Serial.print(PORTB & 1); (void)other;
  other = cogstart(pump, 0, stack, sizeof stack); delay(1); Serial.print(DDRD >> 6 & 3);
  cogstop(other); Serial.print(DDRD >> 6 & 3);
} void loop() { delay(1); }
"""
    uses = ["simpletools.h/cog_run", "simpletools.h/cog_end", "propeller.h/cogstart", "propeller.h/cogstop", "simpletools.h/high"]
    assert cogs(uno, program, uses) == "312001120"
