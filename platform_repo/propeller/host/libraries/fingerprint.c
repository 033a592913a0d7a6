/* fingerprint.h: commands and answers of eight bytes at 19,200 baud. Source: libfingerprint/fingerprint.c. */
#include "simpletools.h"
#include "fingerprint.h"

enum { BAUD = 19200, START_MS = 100, FRAME = 0xF5, BYTES = 8, USERS_LED = 26 };

fpScanner *fingerprint_open(int pin_rx, int pin_tx) { return host_serial_line(pin_rx, pin_tx, 0, BAUD, START_MS); }

void fingerprint_close(fpScanner *device) { fdserial_close(device); }

void fingerprint_sendCommand(fpScanner *device, char __fpCmd, char __fpParam1, char __fpParam2, char __fpParam3) {
  int sum = __fpCmd ^ __fpParam1 ^ __fpParam2 ^ __fpParam3;
  int bytes[BYTES] = {FRAME, __fpCmd, __fpParam1, __fpParam2, __fpParam3, 0, sum, FRAME};
  for (int k = 0; k < BYTES; k++) fdserial_txChar(device, bytes[k]);
}

void fingerprint_readResponse(fpScanner *device, char *__fpResponse) {
  int bytes[BYTES], sum = 0;
  for (int k = 0; k < BYTES; k++) {
    bytes[k] = fdserial_rxChar(device);
    if (k >= 1 && k <= 5) sum ^= bytes[k];
    if (k >= 2 && k <= 4) __fpResponse[k - 2] = bytes[k];
  }
  __fpResponse[4] = 0;
  if (bytes[0] == FRAME && bytes[7] == FRAME && bytes[6] == sum) __fpResponse[5] = FRAME;
}

/* The third byte of an answer; all three go to `answer`. */
static int ask(fpScanner *device, int command, int number, int more, char *answer) {
  char text[BYTES] = {0};
  fingerprint_sendCommand(device, command, number >> 8 & 0xFF, number & 0xFF, more);
  fingerprint_readResponse(device, text);
  if (answer) memcpy(answer, text, 3);
  return text[2];
}

int fingerprint_allowOverwrite(fpScanner *device, char b) { return ask(device, CMD_SET_MODE, !b, 0, 0); }

int fingerprint_add(fpScanner *device, int userId, char userLevel, int scanNumber) {
  int single = scanNumber >= 1 && scanNumber <= 3;
  if (userId < 1) return ACK_NOUSER;
  for (int scan = single ? scanNumber : 1; scan <= 3; scan++) {
    int said = ask(device, scan, userId, userLevel & 3, 0);  /* the commands of the three scans are 1 to 3 */
    if (single || scan == 3) break;
    if (said != ACK_SUCCESS) return said;
    pause(1000);
  }
  return 0;  /* of another byte, which is always 0 */
}

int fingerprint_deleteUser(fpScanner *device, int userId) {
  ask(device, userId < 1 ? CMD_DELETE_ALL_USERS : CMD_DELETE_USER, userId < 1 ? 0 : userId, 0, 0);
  if (userId < 1) high(USERS_LED);
  return 0;
}

int fingerprint_countUsers(fpScanner *device) {
  char said[3];
  return ask(device, CMD_GET_USERS_COUNT, 0, 0, said) ? -1 : said[0] << 8 | said[1];
}

int fingerprint_scan(fpScanner *device, int userId, int *uid) {
  char said[3];
  *uid = 0;
  if (userId < 1) {
    int level = ask(device, CMD_SCAN_COMPARE_1_TO_N, 0, 0, said);
    *uid = said[0] << 8 | said[1];
    return level;
  }
  int done = ask(device, CMD_SCAN_COMPARE_1_TO_1, userId, 0, 0);
  if (done != ACK_SUCCESS) return done;
  *uid = userId;
  return ask(device, CMD_READ_USER_PRIVLAGE, userId, 0, 0);
}

int fingerprint_lookupUserPrivlage(fpScanner *device, int userId) {
  return userId > 0 ? ask(device, CMD_READ_USER_PRIVLAGE, userId, 0, 0) : 0;
}

int fingerprint_setTimeout(fpScanner *device, int timeout) { return ask(device, CMD_SET_SCAN_TIMEOUT, abs(timeout) & 0xFF, 0, 0); }

int fingerprint_setStrictness(fpScanner *device, char s_level) {
  return ask(device, CMD_SENSITIVITY, s_level > 9 ? 9 : s_level, 0, 0);
}
