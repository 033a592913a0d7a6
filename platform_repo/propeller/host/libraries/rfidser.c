/* rfidser.h: a line of 2,400 baud that is only listened to, and a pin that is low while the reader works. Source: librfidser/rfidser.c. */
#include "simpletools.h"
#include "rfidser.h"

enum { READERS = 8, ID = 12, BAUD = 2400, LINE_FEED = 10, CARD_MS = 50 };

static struct reader {
  rfidser *line;
  int enable;
  char id[ID];
} readers[READERS];

static struct reader *of(rfidser *line) {
  for (int i = 0; i < READERS; i++)
    if (readers[i].line == line) return &readers[i];
  return 0;
}

rfidser *rfid_open(int soutPin, int enablePin) {
  struct reader *reader = of(0);
  if (!reader) return 0;
  reader->line = fdserial_open(soutPin, soutPin, FDSERIAL_MODE_OPENDRAIN_TX, BAUD);
  reader->enable = enablePin;
  rfid_reset(reader->line);
  return reader->line;
}

void rfidser_close(rfidser *device) {
  struct reader *reader = of(device);
  fdserial_close(device);
  if (reader) reader->line = 0;
}

void rfid_reset(rfidser *device) {
  rfid_disable(device);
  rfid_enable(device);
}

void rfid_disable(rfidser *device) { high(of(device)->enable); }

void rfid_enable(rfidser *device) { low(of(device)->enable); }

char *rfid_get(rfidser *device, int timeoutms) {
  char *id = of(device)->id;
  memset(id, 0, ID);
  unsigned begun = CNT, limit = 80000u * (unsigned)timeoutms;
  while (fdserial_rxCheck(device) != LINE_FEED)
    if (CNT - begun > limit) return strcpy(id, "timed out");
  pause(CARD_MS);
  readStr(device, id, ID);
  return id;
}
