static void away(int32_t speed)
{
  drive_speed(-speed, -speed);
  pause(500);
}

int32_t near(int32_t limit)
{
  return ping_cm(255 /* P8 is not wired yet */) < limit;
}
