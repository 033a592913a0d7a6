static void away(int speed)
{
  drive_speed(-speed, -speed);
  pause(500);
}

int near(int limit)
{
  return ping_cm(8) < limit;
}
