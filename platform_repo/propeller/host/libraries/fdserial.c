/* fdserial.h: a cog sends and receives at the same time; 64 bytes wait in either direction, older ones are written over.
 * Sources: libfdserial (fdserial.c, fdserial_utils.c; its driver is in machine code). */
#include "simpletools.h"
#include "fdserial.h"

enum { SIZE = FDSERIAL_BUFF_MASK + 1, CONSOLE_RX = 31, CONSOLE_TX = 30 };

static void received(fdserial_st *line, int byte) {
  line->buffptr[line->rx_head] = byte;
  line->rx_head = (line->rx_head + 1) & FDSERIAL_BUFF_MASK;
}

/* The next byte to send, -1 without one. It leaves the buffer when it is on its way. */
static int to_send(fdserial_st *line) {
  if (line->tx_tail == line->tx_head) return -1;
  int byte = (unsigned char)line->buffptr[SIZE + line->tx_tail];
  line->tx_tail = (line->tx_tail + 1) & FDSERIAL_BUFF_MASK;
  return byte;
}

static void serve_console(void *parameter) {
  fdserial_st *line = parameter;
  for (host_time free_from = 0;;) {
    if (free_from <= host_now()) {
      int byte = to_send(line);
      if (byte >= 0) {
        host_console_write(byte);
        free_from = host_now() + 10 * line->ticks;
      }
    }
    int typed = host_console_read(host_now() + 5 * line->ticks);
    if (typed >= 0) {
      received(line, typed);
      host_spend(10 * line->ticks);
    }
  }
}

static void put(fdserial_st *line, int bit) {
  unsigned mask = 1u << line->tx_pin;
  int level = line->mode & FDSERIAL_MODE_INVERT_TX ? !bit : bit;
  if (line->mode & FDSERIAL_MODE_OPENDRAIN_TX) {
    OUTA = level ? OUTA | mask : OUTA & ~mask;
    DIRA = bit ? DIRA & ~mask : DIRA | mask;
  } else {
    OUTA = level ? OUTA | mask : OUTA & ~mask;
    DIRA |= mask;
  }
}

static void serve_pins(void *parameter) {
  fdserial_st *line = parameter;
  unsigned mask = 1u << line->rx_pin, idle = line->mode & FDSERIAL_MODE_INVERT_RX ? 0 : mask, frame = 0, byte = 0;
  int bits_left = 0, bits_seen = -1;
  host_time next_bit = 0, next_sample = 0;
  if (!(line->mode & FDSERIAL_MODE_RX_ONLY)) put(line, 1);
  for (;;) {
    host_time now = host_now(), until = now + line->ticks / 2;
    if (bits_left && next_bit <= now) {
      put(line, frame & 1);
      frame >>= 1, bits_left--;
      next_bit += line->ticks;
    } else if (!bits_left && next_bit <= now) {
      int sent = to_send(line);
      if (sent >= 0) frame = (sent | 0x100) << 1, bits_left = 10, next_bit = now;
    }
    if (bits_seen >= 0 && next_sample <= now) {
      int bit = (host_pins() & mask) == idle;
      if (bits_seen < 8) byte |= (unsigned)bit << bits_seen;
      else received(line, byte);
      bits_seen = bits_seen < 8 ? bits_seen + 1 : -1;
      next_sample += line->ticks;
    }
    if (bits_left && next_bit < until) until = next_bit;
    if (bits_seen >= 0 && next_sample < until) until = next_sample;
    if (until <= now) until = now + 1;
    if (bits_seen >= 0) host_spend(until - now);
    else if (host_wait_pins(mask, idle, 0, until) && line->rx_pin >= 0) {
      bits_seen = 0, byte = 0;
      next_sample = host_now() + line->ticks + line->ticks / 2;
      if (next_sample <= host_now()) host_spend(1);
    }
  }
}

fdserial *host_serial_line(int rxpin, int txpin, int mode, int baudrate, int wait_ms) {
  fdserial *term = calloc(1, sizeof *term);
  fdserial_st *line = calloc(1, sizeof *line);
  char *buffers = malloc(2 * SIZE);
  int console = rxpin == CONSOLE_RX && txpin == CONSOLE_TX;
  host_call();
  if (!term || !line || !buffers || baudrate <= 0) return 0;
  if (console) simpleterm_close();
  if ((mode & FDSERIAL_MODE_RX_ONLY) || txpin > 31 || txpin < 0) mode |= FDSERIAL_MODE_RX_ONLY | FDSERIAL_MODE_OPENDRAIN_TX;
  *line = (fdserial_st){0, 0, 0, 0, rxpin & 31, txpin & 31, mode, HOST_HZ / baudrate, buffers};
  *term = (fdserial){fdserial_rxChar, fdserial_txChar, {0}, line, (mode & FDSERIAL_MODE_ECHO_RX_TO_TX) != 0, 0, 0, 0, 0};
  if (console) term->ecA = term->ecsA = '\r', term->ecB = '\n';
  term->cogid[0] = setStopCOGID(host_start(console ? serve_console : serve_pins, line, -1));
  host_sleep_until(host_now() + (host_time)wait_ms * HOST_TICKS_PER_MS);
  return term;
}

fdserial *fdserial_open(int rxpin, int txpin, int mode, int baudrate) { return host_serial_line(rxpin, txpin, mode, baudrate, 500); }

void fdserial_close(fdserial *term) {
  fdserial_st *line = (fdserial_st *)term->devst;
  fdserial_rxFlush(term);
  fdserial_txFlush(term);
  if (term->cogid[0] > 0) host_stop(getStopCOGID(term->cogid[0]));
  free(line->buffptr);
  free(line);
  free(term);
}

int fdserial_rxReady(fdserial *term) {
  fdserial_st *line = (fdserial_st *)term->devst;
  host_call();
  return line->rx_tail != line->rx_head;
}

int fdserial_rxPeek(fdserial *term) {
  fdserial_st *line = (fdserial_st *)term->devst;
  return fdserial_rxReady(term) ? (unsigned char)line->buffptr[line->rx_tail] : 0;
}

int fdserial_rxCount(fdserial *term) {
  fdserial_st *line = (fdserial_st *)term->devst;
  host_call();
  return (line->rx_head - line->rx_tail) & FDSERIAL_BUFF_MASK;
}

int fdserial_rxCheck(fdserial *term) {
  fdserial_st *line = (fdserial_st *)term->devst;
  if (!fdserial_rxReady(term)) return -1;
  int byte = (unsigned char)line->buffptr[line->rx_tail];
  line->rx_tail = (line->rx_tail + 1) & FDSERIAL_BUFF_MASK;
  return byte;
}

int fdserial_rxChar(fdserial *term) {
  int byte;
  while ((byte = fdserial_rxCheck(term)) < 0) {}
  return byte;
}

int fdserial_rxTime(fdserial *term, int ms) {
  host_time begun = host_now();
  for (;;) {
    int byte = fdserial_rxCheck(term);
    if (byte >= 0 || (int)((host_now() - begun) / HOST_TICKS_PER_MS) > ms) return byte;
  }
}

void fdserial_rxFlush(fdserial *term) {
  while (fdserial_rxCheck(term) >= 0) {}
}

int fdserial_txEmpty(fdserial *term) {
  fdserial_st *line = (fdserial_st *)term->devst;
  host_call();
  return line->tx_tail == line->tx_head;
}

void fdserial_txFlush(fdserial *term) {
  while (!fdserial_txEmpty(term)) {}
}

int fdserial_txChar(fdserial *term, int txbyte) {
  fdserial_st *line = (fdserial_st *)term->devst;
  host_call();
  if (line->mode & FDSERIAL_MODE_RX_ONLY) return -1;
  while (line->tx_tail == ((line->tx_head + 1) & FDSERIAL_BUFF_MASK)) host_call();
  line->buffptr[SIZE + line->tx_head] = txbyte;
  line->tx_head = (line->tx_head + 1) & FDSERIAL_BUFF_MASK;
  return line->mode & FDSERIAL_MODE_IGNORE_TX_ECHO ? fdserial_rxChar(term) : -1;
}
