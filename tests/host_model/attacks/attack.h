/* What an attack tries, by system calls of its own; place.h says where, and with which effect it begins. */
#include "place.h"

static int call(int number, int a, int b, int c) {
  int result;
  __asm__ volatile("int $0x80" : "=a"(result) : "0"(number), "b"(a), "c"(b), "d"(c) : "memory");
  return result;
}

static void write_file(void) {
  int file = call(5, (int)(PLACE "/file"), 0101, 0644);
  call(4, file, (int)"owned\n", 6);
}

static void connect_to(int abstract) {
  static struct { unsigned short family; char path[108]; } address = { 1, "" };
  const char *from = abstract ? ABSTRACT : PLACE "/socket";
  int length = 0;
  for (; from[length]; length++) address.path[length + abstract] = from[length];
  int file = call(359, 1, 1, 0);
  call(362, file, (int)&address, 2 + length + 1);
  call(4, file, (int)"hello", 5);
}

static void send_udp(void) {
  static struct { unsigned short family, port; unsigned host; char zero[8]; } address = { 2, PORT, 0x0100007F };
  int file = call(359, 2, 2, 0);
  call(362, file, (int)&address, 16);
  call(4, file, (int)"hello", 5);
}

static void fork_away(void) {
  if (call(2, 0, 0, 0) == 0) {
    call(66, 0, 0, 0);
    for (;;) call(29, 0, 0, 0);  /* pause */
  }
  static int half_a_second[2] = { 0, 500000000 };
  call(162, (int)half_a_second, 0, 0);
}

static void execute(void) {
  static char *arguments[] = { "/bin/sh", "-c", "echo owned > " PLACE "/executed", 0 };
  call(11, (int)arguments[0], (int)arguments, 0);
}

/* The call that starts the program is one of 64 bits: go on in that mode, and make it again. */
static void start_again(void) {
  static struct { unsigned at; unsigned short selector; } to;
  __asm__ volatile("movl $1f, %0\n\tmovw $0x33, 4+%0\n\tljmp *%0\n"
                   "1:\n\t.byte 0x48, 0xc7, 0xc0\n\t.long 322\n\t.byte 0x48, 0xc7, 0xc7\n\t.long 3\n"
                   "\t.byte 0x48, 0xbe\n\t.long 0, 0x7fff\n\t.byte 0x48, 0x31, 0xd2\n\t.byte 0x4d, 0x31, 0xd2\n"
                   "\t.byte 0x49, 0xc7, 0xc0\n\t.long 0x1000\n\t.byte 0x0f, 0x05" : "+m"(to) : : "eax", "ecx", "edx", "esi", "edi", "memory");
}

static void attack(void) {
  for (int n = 0; n < EFFECTS; n++) switch ((EFFECT + n) % 12) {
    case 0: write_file(); break;
    case 1: connect_to(0); break;
    case 2: connect_to(1); break;
    case 3: send_udp(); break;
    case 4: call(37, VICTIM, 10, 0); break;                          /* kill: SIGUSR1 */
    case 5: call(26, 16, VICTIM, 0); break;                          /* ptrace: attach */
    case 6: call(39, (int)(PLACE "/folder"), 0755, 0); break;        /* mkdir */
    case 7: call(38, (int)(PLACE "/kept"), (int)(PLACE "/moved"), 0); break;  /* rename */
    case 8: call(395, KEY, 4096, 01666); break;                      /* shmget */
    case 9: fork_away(); break;
    case 10: start_again(); break;
    default: execute();
  }
}
