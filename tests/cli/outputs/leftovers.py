"""Kills runs and saves at random moments and looks at what the next run leaves."""
import os
import shutil
import signal
import subprocess
import sys
import time

rapidc, folder = sys.argv[1], sys.argv[2]
work = os.path.join(folder, "work")
temporary = os.path.join(folder, "temporary")
for path in (work, temporary):
    shutil.rmtree(path, ignore_errors=True)
    os.makedirs(path)
environment = dict(os.environ, TMPDIR=temporary)
endless = os.path.join(work, "endless.modx")
short = os.path.join(work, "short.modx")
with open(endless, "w") as file:
    file.write("MODULE endless\n  PERS num n := 0;\n  PROC main()\n    WHILE TRUE DO\n      n := n + 1;\n"
               "      WaitTime 0.1;\n    ENDWHILE\n  ENDPROC\nENDMODULE\n")
with open(short, "w") as file:
    file.write("MODULE short\n  PROC main()\n    TPWrite \"done\";\n  ENDPROC\nENDMODULE\n")


def start(*arguments):
    return subprocess.Popen([rapidc, "run", *arguments], env=environment, stdout=subprocess.DEVNULL,
                            stderr=subprocess.DEVNULL)


def homes():
    return sorted(name for name in os.listdir(temporary) if "home" in name)


def wait_for_home(count):
    end = time.time() + 15
    while len(homes()) < count and time.time() < end:
        time.sleep(0.02)
    assert len(homes()) == count, homes()


# a run that is killed leaves its HOME:, one that lives keeps it
killed = start(endless, "--realtime")
wait_for_home(1)
of_killed = homes()
living = start(endless, "--realtime")
wait_for_home(2)
of_living = [name for name in homes() if name not in of_killed]
killed.send_signal(signal.SIGKILL)
killed.wait()
assert homes() != of_living  # it is still there
foreign = ["rapidc-home-notes", "rapidc_home_x", "home-1-abcdef"]
for name in foreign:
    os.makedirs(os.path.join(temporary, name))
link = os.path.join(temporary, "rapidc-home-1-abcdef")
os.symlink(work, link)  # a link is not ours, whatever it is called

# names of temporary files of writers: ours, of another program, and of a writer that lives
left = os.path.join(work, ".endless.modx.rapidc-4711-aB3dE6.tmp")
others = [os.path.join(work, name) for name in (".endless.modx.aB3dE6.tmp", ".endless.modx.swp", "short.modx.tmp")]
for path in [left] + others:
    with open(path, "w") as file:
        file.write("half")
held = os.path.join(work, ".short.modx.rapidc-4712-aB3dE6.tmp")
holder = subprocess.Popen([sys.executable, "-c",
                           "import fcntl, sys, time; f = open(sys.argv[1], 'w'); fcntl.flock(f, fcntl.LOCK_EX); "
                           "print('held', flush=True); time.sleep(60)", held], stdout=subprocess.PIPE)
assert holder.stdout.readline() == b"held\n"

state = os.path.join(folder, "state")
os.makedirs(state, exist_ok=True)
left_state = os.path.join(state, ".state.json.rapidc-4711-aB3dE6.tmp")
open(left_state, "w").close()

done = subprocess.run([rapidc, "run", short, "--state=" + state], env=environment, capture_output=True, text=True)
assert done.returncode == 0 and done.stdout == "done\n", done
assert not os.path.exists(left)
assert not os.path.exists(left_state)
assert os.path.exists(held)
assert all(os.path.exists(path) for path in others)
assert os.path.islink(link) and os.path.isdir(work)
os.unlink(link)
assert homes() == sorted(of_living + foreign), homes()

holder.kill()
holder.wait()
living.terminate()
living.wait()
assert homes() == sorted(foreign), homes()

# a writer is killed at any moment: a complete module, and nothing but the module after the next write
values = os.path.join(folder, "values")
big = os.path.join(work, "big.modx")
with open(big, "w") as file:
    file.write("MODULE big\n  PERS num n := 0;\n" + "  ! text\n" * 20000 + "ENDMODULE\n")
for round in range(12):
    with open(values, "w") as file:
        file.write("big.n=%d\n" % round)
    writer = subprocess.Popen([rapidc, "set-value", "--values=" + values, big], env=environment)
    time.sleep(0.004 * round)
    writer.kill()
    writer.wait()
    with open(big) as file:
        assert file.read().endswith("ENDMODULE\n")
subprocess.run([rapidc, "set-value", "--values=" + values, big], env=environment, check=True)
remaining = [name for name in os.listdir(work) if name.startswith(".big")]
assert remaining == [], remaining
