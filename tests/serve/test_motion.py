"""The motion system: positions, frames, kinematics, jogging (contract 22, 31, 32, 38, 39; facts 2.3 Motion)."""

import math

from serve_testing import ServeCase, main

MODULE = """MODULE MainModule
  PERS tooldata grip := [TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];
  PERS wobjdata table := [FALSE,TRUE,"",[[300,100,0],[1,0,0,0]],[[0,0,50],[1,0,0,0]]];
  CONST jointtarget home := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveAbsJ home, v1000, fine, tool0;
    MoveAbsJ [[20,10,10,5,40,10],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
    Stop;
  ENDPROC
ENDMODULE
"""
UNIT = "/rw/motionsystem/mechunits/ROB_1"
FREE = ["9E+09"] * 6


def numbers(values, names):
    return [float(values[name]) for name in names]


def axes(client, unit=UNIT):
    return numbers(client.get(unit + "/jointtarget").values("ms-jointtarget"), [f"rax_{i}" for i in range(1, 7)])


class Motion(ServeCase):
    MODULE = MODULE
    OPTIONS = ("--no-program-start",)

    def teleport(self, client, joints):
        fields = {"rob_joint": "[" + ",".join(map(str, joints)) + "]", "ext_joint": "[9E9,9E9,9E9,9E9,9E9,9E9]"}
        return client.act(UNIT, "mechunit-position", fields, action2="position")

    def mover(self, dialect):
        client = self.client(dialect)
        if dialect == 2:
            self.assertEqual(client.post("/rw/mastership/motion/request").status, 204)
        return client

    def manual(self, client):
        """Manual mode with motors on."""
        self.assertEqual(client.post("/rw/panel/opmode" + ("?action=setopmode" if client.dialect == 1 else ""),
                                     {"opmode": "man"}).status, 204)
        path = "/rw/panel/ctrlstate?action=setctrlstate" if client.dialect == 1 else "/rw/panel/ctrl-state"
        self.assertEqual(client.post(path, {"ctrl-state": "motoron"}).status, 204)
        self.addCleanup(lambda: self.client(1).post("/rw/panel/opmode?action=setopmode", {"opmode": "auto"}))

    def test_units(self):
        """Facts 2.3: li ms-mechunit-li; static and dynamic; librws fails when any span is empty."""
        for client in self.both():
            entry = client.get("/rw/motionsystem/mechunits").entries("ms-mechunit-li")[0]
            self.assertEqual((entry.title, entry.values["mode"]), ("ROB_1", "Activated"))
            static = client.get(UNIT + "?resource=static").values()
            self.assertEqual((static["task-name"], static["type"], static["axes"], static["has-integrated-unit"]),
                             ("T_ROB1", "TCPRobot", "6", "NoIntegratedUnit"))
            dynamic = client.get(UNIT + "?resource=dynamic").values()
            for name in ("task-name", "is-integrated-unit", "has-integrated-unit", "type", "axes", "axes-total"):
                self.assertTrue(static[name], name)
            for name in ("tool-name", "wobj-name", "payload-name", "total-payload-name", "status", "jog-mode", "mode", "coord-system"):
                self.assertTrue(dynamic[name], name)
            self.assertEqual(client.get("/rw/motionsystem/mechunits/ROB_9").status, 404)

    def test_joint_target(self):
        """Facts 2.3: rax_1..6 in degrees, eax_a..f 9E+09 when unused."""
        client = self.mover(2)
        self.assertEqual(self.teleport(client, [10, -20, 30, 40, 50, 60]).status, 204)
        for reader in self.both():
            values = reader.get(UNIT + "/jointtarget").values("ms-jointtarget")
            for found, wanted in zip(axes(reader), [10, -20, 30, 40, 50, 60]):
                self.assertAlmostEqual(found, wanted, 4)
            self.assertEqual([values[f"eax_{letter}"] for letter in "abcdef"], FREE)

    def test_robtarget(self):
        """Facts 2.3: tool, wobj, coordinate; both World and Word. Tool and work object displace along z and by their frames."""
        self.teleport(self.mover(2), [0, 0, 0, 0, 90, 0])  # the flange looks down
        names = ["x", "y", "z", "q1", "q2", "q3", "q4"]
        for client in self.both():
            read = lambda query: client.get(f"{UNIT}/robtarget{query}").values("ms-robtargets")  # noqa: E731
            plain = read("?tool=tool0&wobj=wobj0&coordinate=Base")
            for name in names + ["cf1", "cf4", "cf6", "cfx"] + [f"eax_{c}" for c in "abcdef"] + [f"eax{c}" for c in "abcdef"]:
                self.assertIn(name, plain)
            at = numbers(plain, names)
            for word in ("World", "Word"):
                self.assertEqual(numbers(read(f"?tool=tool0&wobj=wobj0&coordinate={word}"), names), at)
            grip = numbers(read("?tool=grip&wobj=wobj0&coordinate=World"), names)
            self.assertAlmostEqual(at[2] - grip[2], 100, 2)
            table = numbers(read("?tool=tool0&wobj=table"), names)
            for found, wanted in zip(table, [at[0] - 300, at[1] - 100, at[2] - 50]):
                self.assertAlmostEqual(found, wanted, 2)
            for query in ("?tool=none", "?wobj=none", "?coordinate=Moon", "?tool=table"):
                self.assertEqual(client.get(f"{UNIT}/robtarget{query}").status, 400, query)
            cartesian = client.get(UNIT + "/cartesian").values()
            self.assertEqual(numbers(cartesian, names), at)

    def test_poses_of_axes(self):
        """2.3 (axes/N): the frame of an axis has z along it; axis 1 turns about the vertical, axis 2 leans the arm forward (about y)."""
        self.teleport(self.mover(2), [0, 10, 20, 0, 30, 0])
        for client in self.both():
            for path in [UNIT + "/axes/{}?resource=pose"] + ([UNIT + "/axes/{}/pose"] if client.dialect == 2 else []):
                for axis, wanted in ((1, (0, 0, 1)), (2, (0, 1, 0)), (3, (0, 1, 0)), (5, (0, 1, 0))):
                    pose = client.get(path.format(axis)).values("ms-mechunit-axispose")
                    w, x, y, z = numbers(pose, ["q1", "q2", "q3", "q4"])
                    along = (2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y))
                    for found, value in zip(along, wanted):
                        self.assertAlmostEqual(found, value, 6, (path, axis))
                self.assertEqual(numbers(client.get(path.format(1)).values(), ["x", "y"]), [0, 0])
                self.assertEqual(client.get(path.format(9)).status, 404)

    def test_other_resources(self):
        """Line 22: baseframe, axes (six entries at least), errorstate, motionsupervision, lead-through."""
        for client in self.both():
            base = client.get(UNIT + "/baseframe").values()
            self.assertEqual(numbers(base, ["x", "y", "z", "q1", "q2", "q3", "q4"]), [0, 0, 0, 1, 0, 0, 0])
            self.assertGreaterEqual(len(client.get(UNIT + "/axes").entries()), 6)
            self.assertEqual(client.get(UNIT + "/axes/3").status, 200)
            self.assertEqual(client.get(UNIT + "/axes/9").status, 404)
            self.assertIn(client.get(UNIT + "/smbdata").status, (403, 404))  # an ideal robot has none
            self.assertTrue(client.get("/rw/motionsystem/errorstate").values("ms-errorstate")["err-state"])
            self.assertIn("mode", client.get(UNIT + "/motionsupervision").values())
            self.assertIn("ccount", client.get("/rw/motionsystem?resource=change-count").values())
        self.assertIn("status", self.client(2).get(UNIT + "/lead-through").values())

    def test_active_tool(self):
        """Line 31: ?action=set | POST U, form tool; a change raises the change count; line 38: motion mastership in 2.0."""
        self.assertEqual(self.client(2).post(UNIT, {"tool": "grip"}).status, 403)
        for dialect in (1, 2):
            client = self.mover(dialect)
            count = lambda: int(client.get("/rw/motionsystem?resource=change-count").values()["ccount"])  # noqa: E731
            path = UNIT + ("?action=set" if dialect == 1 else "")
            before = count()
            self.assertEqual(client.post(path, {"tool": "grip", "wobj": "table"}).status, 204)
            self.assertGreater(count(), before)
            dynamic = client.get(UNIT + "?resource=dynamic").values()
            self.assertEqual((dynamic["tool-name"], dynamic["wobj-name"]), ("grip", "table"))
            for fields in ({"tool": "none"}, {"wobj": "grip"}, {}):
                self.assertEqual(client.post(path, fields).status, 400)
            self.assertEqual(client.post(path, {"tool": "tool0", "wobj": "wobj0"}).status, 204)
            client.close()

    def test_lead_through(self):
        client = self.mover(2)
        for word in ("active", "inactive"):
            self.assertEqual(client.post(UNIT + "/lead-through", {"status": word}).status, 204)
            self.assertEqual(client.get(UNIT + "/lead-through").values()["status"].lower(), word)
        self.assertEqual(client.post(UNIT + "/lead-through", {"status": "odd"}).status, 400)
        other = self.client(2)
        self.assertEqual(other.post(UNIT + "/lead-through", {"status": "active"}).status, 403)  # line 37
        client.close()
        self.eventually(lambda: other.get("/rw/mastership/motion").values()["mastership"] == "nomaster")
        for word in ("active", "inactive"):  # line 38: motion is for jog, teleport and active tool
            self.assertEqual(other.post(UNIT + "/lead-through", {"status": word}).status, 204)

    # ---- Kinematics ----------------------------------------------------------------------------------------------------

    def pose(self, client, joints, **more):
        fields = {"rob_joints": str(joints), "ext_joints": "[9E9,9E9,9E9,9E9,9E9,9E9]", "tool_frame_position": "[0,0,0]",
                  "tool_frame_orientation": "[1,0,0,0]", "robot_fixed_object": "FALSE", "elog_at_error": "FALSE", **more}
        return client.act(UNIT, "CalcPoseFromJoints", fields, action2="pose-from-joints")

    def pose_fields(self, values, **more):
        position = numbers(values, [f"position-{c}" for c in "xyz"])
        turn = numbers(values, [f"robtargetorientation-u{i}" for i in range(4)])
        return {"curr_position": str(position), "curr_orientation": str(turn), "tool_frame_position": "[0,0,0]",
                "tool_frame_orientation": "[1,0,0,0]", "curr_ext_joints": "[9E9,9E9,9E9,9E9,9E9,9E9]",
                "robot_fixed_object": "FALSE", "elog_at_error": "FALSE", **more}

    def test_kinematics(self):
        """Facts 2.3: metres and radians, there and back; the pose is that of robtarget."""
        degrees = [10, 20, -15, 30, 40, 50]
        joints = [math.radians(value) for value in degrees]
        self.teleport(self.mover(2), degrees)
        for client in self.both():
            response = self.pose(client, joints)
            self.assertEqual(response.status, 200)
            values = response.values()
            target = client.get(UNIT + "/robtarget?tool=tool0&wobj=wobj0&coordinate=Base").values()
            for found, wanted in zip(numbers(values, [f"position-{c}" for c in "xyz"]), numbers(target, "xyz")):
                self.assertAlmostEqual(found, wanted / 1000, 5)
            for name in ("j1", "j4", "j6", "jx"):
                self.assertIn(f"quarter-rev-{name}", values)
            seed = str([value + 0.1 for value in joints])
            back = client.act(UNIT, "JointsFromCartesian", self.pose_fields(values, old_rob_joints=seed), action2="joints-from-cartesian")
            for found, wanted in zip(numbers(back.values(), [f"robotjoint{i}" for i in range(1, 7)]), joints):
                self.assertAlmostEqual(found, wanted, 5)
            conf = str([int(values[f"quarter-rev-{name}"]) for name in ("j1", "j4", "j6", "jx")])
            fields = self.pose_fields(values, old_rob_joints="[0,0,0,0,0,0]", robot_configuration=conf)
            back = client.act(UNIT, "JointsFromCartesian", fields, action2="joints-from-cartesian")
            for found, wanted in zip(numbers(back.values(), [f"robotjoint{i}" for i in range(1, 7)]), joints):
                self.assertAlmostEqual(found, wanted, 5)

    def test_tool_frame(self):
        """A tool of 0.1 m along z moves the pose by that."""
        client = self.client(1)
        joints = [0, 0, 0, 0, math.pi / 2, 0]
        plain = self.pose(client, joints).values()
        longer = self.pose(client, joints, tool_frame_position="[0,0,0.1]").values()
        self.assertAlmostEqual(float(plain["position-z"]) - float(longer["position-z"]), 0.1, 6)

    def test_all_solutions(self):
        """Line 32: a list, an entry per solution with robotjoint1..6; each leads to the same pose."""
        joints = [0.1, 0.2, -0.3, 0.4, 0.5, 0.6]
        for client in self.both():
            values = self.pose(client, joints).values()
            response = client.act(UNIT, "AllJointSolutions", self.pose_fields(values), action2="all-joints-solution")
            solutions = [numbers(entry.values, [f"robotjoint{i}" for i in range(1, 7)]) for entry in response.entries()]
            self.assertGreater(len(solutions), 1)
            # A11 reads the class and the quarters of each solution.
            quarters = [[entry.values[f"quarter_rev_{axis}"] for axis in ("j1", "j4", "j6", "jx")]
                        for entry in response.entries("all-joint-solutions")]
            self.assertEqual(len(quarters), len(solutions))
            self.assertTrue(any(max(abs(a - b) for a, b in zip(solution, joints)) < 1e-5 for solution in solutions))
            for solution in solutions:
                again = self.pose(client, solution).values("position-from-joint")
                self.assertEqual([again[f"quarter-rev-{axis}"] for axis in ("j1", "j4", "j6", "jx")], quarters.pop(0))
                for name in ("position-x", "position-y", "position-z"):
                    self.assertAlmostEqual(float(again[name]), float(values[name]), 6)

    def test_out_of_reach(self):
        """Line 32: an error and no joints."""
        for client in self.both():
            values = self.pose(client, [0, 0, 0, 0, 0.5, 0]).values()
            fields = {**self.pose_fields(values), "curr_position": "[9,9,9]"}
            for action, name in (("JointsFromCartesian", "joints-from-cartesian"), ("AllJointSolutions", "all-joints-solution")):
                response = client.act(UNIT, action, fields, action2=name)
                self.assertEqual(response.status // 100, 4)
                self.assertNotIn(b"robotjoint", response.body)
            for wrong in ({"curr_position": "[1,2]"}, {"curr_orientation": "[9,9,9,9]"}, {"curr_position": "[nan,0,0]"},
                          {"robot_configuration": "[1e300,0,0,0]"}, {"old_rob_joints": "x"}):
                response = client.act(UNIT, "JointsFromCartesian", {**self.pose_fields(values), **wrong}, action2="joints-from-cartesian")
                self.assertEqual(response.status, 400, wrong)

    # ---- Moving --------------------------------------------------------------------------------------------------------

    def test_teleport(self):
        """Line 31: POST U/position rob_joint ext_joint; axis limits hold; line 38: motion mastership."""
        self.assertEqual(self.teleport(self.client(2), [0, 0, 0, 0, 30, 0]).status, 403)
        client = self.mover(2)
        self.assertEqual(self.teleport(client, [5, 6, 7, 8, 9, 10]).status, 204)
        self.assertEqual([round(value, 3) for value in axes(client)], [5, 6, 7, 8, 9, 10])
        self.assertEqual(self.teleport(client, [500, 0, 0, 0, 0, 0]).status, 403)
        self.assertEqual(client.post(UNIT + "/position", {"rob_joint": "[1,2]", "ext_joint": "[]"}).status, 400)
        self.assertEqual([round(value, 3) for value in axes(client)], [5, 6, 7, 8, 9, 10])

    def jog(self, client, values, **more):
        fields = {f"axis{i}": value for i, value in enumerate(values, 1)}
        return client.act("/rw/motionsystem", "jog", {**fields, "ccount": 1, **more})

    def test_jogging_is_for_manual_mode(self):
        """Line 39: in automatic mode 4xx; line 38: motion mastership."""
        for dialect in (1, 2):
            client = self.mover(dialect)
            self.assertEqual(self.jog(client, [500, 0, 0, 0, 0, 0]).status // 100, 4)
            client.close()
        other = self.client(2)
        response = self.jog(other, [500, 0, 0, 0, 0, 0])
        self.assertEqual((response.status, response.code()), (403, -1073445859))

    def at_rest(self, client):
        seen = [None]

        def stands():
            now = axes(client)
            same = seen[0] == now
            seen[0] = now
            return same
        self.eventually(stands)
        return seen[0]

    def test_jog_joints(self):
        """Axis 1 alone moves in the direction asked for and stops by itself when the order is not repeated."""
        for dialect in (1, 2):
            client = self.mover(dialect)
            self.teleport(client, [0, 0, 0, 0, 30, 0])
            self.manual(client)
            self.assertEqual(self.jog(client, [500, 0, 0, 0, 0, 0], jogmode="AxisGroup1").status, 204)
            self.eventually(lambda: axes(client)[0] > 0.5)
            end = self.at_rest(client)
            self.assertGreater(end[0], 0.5)
            self.assertLess(end[0], 45)
            for found, wanted in zip(end[1:], [0, 0, 0, 30, 0]):
                self.assertAlmostEqual(found, wanted, 4)
            client.close()

    def test_jog_along_a_line(self):
        client = self.mover(2)
        self.teleport(client, [0, 0, 0, 0, 60, 0])
        self.manual(client)
        where = lambda: numbers(client.get(UNIT + "/robtarget?coordinate=World").values(),  # noqa: E731
                                ["x", "y", "z", "q1", "q2", "q3", "q4"])
        begin = where()
        self.assertEqual(self.jog(client, [0, 0, 300, 0, 0, 0], jogmode="Cartesian").status, 204)
        self.at_rest(client)
        end = where()
        self.assertGreater(end[2] - begin[2], 1)
        for index in (0, 1, 3, 4, 5, 6):
            self.assertAlmostEqual(end[index], begin[index], 2)

    def test_jog_reorients_about_the_tcp(self):
        client = self.mover(2)
        self.teleport(client, [0, 0, 0, 0, 60, 0])
        client.post(UNIT, {"tool": "grip"})
        self.addCleanup(lambda: client.post(UNIT, {"tool": "tool0"}))
        self.manual(client)
        where = lambda: numbers(client.get(UNIT + "/robtarget?tool=grip&coordinate=World").values(),  # noqa: E731
                                ["x", "y", "z", "q1", "q2", "q3", "q4"])
        begin = where()
        self.assertEqual(self.jog(client, [0, 0, 0, 0, 500, 0], jogmode="Cartesian").status, 204)
        self.at_rest(client)
        end = where()
        for index in range(3):
            self.assertAlmostEqual(end[index], begin[index], 2)
        cosine = abs(sum(a * b for a, b in zip(begin[3:], end[3:])))
        self.assertGreater(math.degrees(2 * math.acos(min(1, cosine))), 1)

    def test_increments(self):
        """inc-mode Large: 5 mm along an axis of the coordinate system, exactly."""
        client = self.mover(2)
        self.teleport(client, [0, 0, 0, 0, 60, 0])
        self.manual(client)
        x = lambda: float(client.get(UNIT + "/robtarget?coordinate=World").values()["x"])  # noqa: E731
        begin = x()
        self.assertEqual(self.jog(client, [1, 0, 0, 0, 0, 0], jogmode="Cartesian", **{"inc-mode": "Large"}).status, 204)
        self.eventually(lambda: abs(x() - begin - 5) < 1e-3)
        self.at_rest(client)
        self.assertAlmostEqual(x() - begin, 5, 3)

    def test_limits_hold(self):
        """An axis stops at the end of its range: axis 5 of an IRB 120 at 120 degrees."""
        client = self.mover(2)
        self.teleport(client, [0, 0, 0, 0, 119.5, 0])
        self.manual(client)

        def push():
            self.jog(client, [0, 0, 0, 0, 1000, 0], jogmode="Joint")
            return axes(client)[4] > 119.9
        self.eventually(push, 10)
        self.assertLessEqual(self.at_rest(client)[4], 120.0001)
        self.assertGreaterEqual(self.jog(client, [0, 0, 0, 0, 1000, 0], jogmode="Joint").status, 204)
        self.assertLessEqual(self.at_rest(client)[4], 120.0001)
        self.assertEqual(self.jog(client, [0, 0, 0, 0, -500, 0], jogmode="Joint").status, 204)
        self.eventually(lambda: axes(client)[4] < 119.5)

    def repeat(self, client, fields, condition, seconds=20):
        """Gives the order of jogging again and again, as a held button does, until the condition holds."""
        def push():
            self.assertEqual(client.act("/rw/motionsystem", "jog", {"axis1": 1000, "ccount": 1, **fields}).status, 204)
            return condition()
        self.eventually(push, seconds)

    def test_jog_to_a_target(self):
        """RWS documentation, jog mode GoToPos: all axes move to the target that was set; the button must be held."""
        names = ["x", "y", "z", "q1", "q2", "q3", "q4"]
        for dialect in (1, 2):
            client = self.mover(dialect)
            self.teleport(client, [20, 10, 10, 0, 40, 0])
            there = client.get(UNIT + "/robtarget").values()
            self.teleport(client, [0, 0, 0, 0, 30, 0])
            self.manual(client)
            self.assertEqual(self.jog(client, [1000, 0, 0, 0, 0, 0], jogmode="GoToPos").status // 100, 4 if dialect == 1 else 2)
            target = {field: there[name] for field, name in zip(
                ("pos-x", "pos-y", "pos-z", "orient-q1", "orient-q2", "orient-q3", "orient-q4"), names)}
            target.update({f"config-j{axis}": there[f"cf{axis}"] for axis in (1, 4, 6)})
            self.assertEqual(client.act("/rw/motionsystem", "positiontarget", target, action2="position-target").status, 204)
            for wrong in ({"pos-x": "far"}, {"orient-q1": "2"}):
                reply = client.act("/rw/motionsystem", "positiontarget", {**target, **wrong}, action2="position-target")
                self.assertEqual(reply.status, 400, wrong)
            # refused while the arm moves
            self.eventually(lambda: self.teleport(client, [0, 0, 0, 0, 30, 0]).status == 204)  # pylint: disable=cell-var-from-loop
            self.jog(client, [1000, 0, 0, 0, 0, 0], jogmode="GoToPos")
            begun = self.at_rest(client)  # not repeated: it stops on the way
            self.assertLess(begun[0], 19)
            self.repeat(client, {"jogmode": "GoToPos"}, lambda: abs(axes(client)[0] - 20) < 0.01)
            for found, wanted in zip(self.at_rest(client), [20, 10, 10, 0, 40, 0]):
                self.assertAlmostEqual(found, wanted, 2)
            client.close()

    def test_jog_aligns_the_tool(self):
        """Jog mode Align: the tool turns about its TCP until its z axis is parallel to an axis of the coordinate system."""
        client = self.mover(2)
        self.teleport(client, [0, 0, 0, 0, 60, 0])  # z of the tool points 30 degrees away from straight down
        self.manual(client)
        where = lambda: numbers(client.get(UNIT + "/robtarget?coordinate=World").values(),  # noqa: E731
                                ["x", "y", "z", "q1", "q2", "q3", "q4"])
        begin = where()

        def z_axis():
            _, _, _, w, x, y, z = where()
            return (2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y))
        self.repeat(client, {"jogmode": "Align"}, lambda: max(map(abs, z_axis())) > 0.999999)
        for found, wanted in zip(where()[:3], begin[:3]):
            self.assertAlmostEqual(found, wanted, 1)

    def test_wrong_orders(self):
        client = self.mover(2)
        self.manual(client)
        for fields in ({"axis1": "x"}, {"axis1": 100, "jogmode": "Odd"}, {"axis1": 100, "inc-mode": "Huge"}, {},
                       {"axis1": "inf"}, {"axis1": 100, "mechunit": "ROB_9"}, {"axis1": 100, "cjogspeed": 200}):
            self.assertEqual(client.post("/rw/motionsystem/jog", fields).status, 400, fields)


class ExternalUnits(ServeCase):
    """Activation by hand (RWS documentation, Set Mechunit: mode=Activated|Deactivated) under the rules of ActUnit and DeactUnit."""
    MODULE = "MODULE m\n PROC main()\n  WaitTime 1;\n ENDPROC\nENDMODULE\n"
    FILES = {"MOC.cfg": """MOC:CFG_1.0:6:0::
#
MECHANICAL_UNIT:

      -name "STN1" -use_single_0 "STN1_A" -activate_at_start_up

      -name "TRACK" -use_single_0 "TRACK_A" -activate_at_start_up -deactivation_forbidden

#
SINGLE:

      -name "STN1_A" -use_joint "STN1_A"

      -name "TRACK_A" -use_joint "TRACK_A"

#
JOINT:

      -name "STN1_A" -logical_axis 7 -use_arm "STN1_A"

      -name "TRACK_A" -logical_axis 8 -use_arm "TRACK_A"
"""}
    OPTIONS = ("--no-program-start",)

    def test_activation(self):
        for dialect in (1, 2):
            client = self.client(dialect)
            if dialect == 2:
                self.assertEqual(client.post("/rw/mastership/motion/request").status, 204)

            def order(unit, mode):
                path = f"/rw/motionsystem/mechunits/{unit}" + ("?action=set" if dialect == 1 else "")
                return client.post(path, {"mode": mode}).status

            def state(unit):
                return client.get(f"/rw/motionsystem/mechunits/{unit}?resource=dynamic").values()["mode"]
            self.assertEqual(state("STN1"), "Activated")
            self.assertEqual(order("STN1", "Deactivated"), 204)
            self.assertEqual(state("STN1"), "Deactivated")
            self.assertEqual(client.get(UNIT + "/jointtarget").values()["eax_a"], "9E+09")  # manual 1.8: not active
            self.assertEqual(order("STN1", "Activated"), 204)
            self.assertEqual(client.get(UNIT + "/jointtarget").values()["eax_a"], "0")
            self.assertEqual(order("TRACK", "Deactivated"), 403)  # deactivation_forbidden
            self.assertEqual(order("ROB_1", "Deactivated"), 403)
            self.assertEqual(order("STN1", "Half"), 400)
            client.close()

    def test_events_of_activation(self):
        """RWS documentation, Subscribe on Mechunit Mode Change: motionsystem-ev counts activations and deactivations."""
        for client in self.both():
            if client.dialect == 2:
                self.assertEqual(client.post("/rw/mastership/motion/request").status, 204)
            response = client.subscribe("/rw/motionsystem/mechunits;mechunitmodechangecount")
            socket = self.socket(client, response)
            for count, mode in (("1", "Deactivated"), ("2", "Activated")):
                path = "/rw/motionsystem/mechunits/STN1" + ("?action=set" if client.dialect == 1 else "")
                self.assertEqual(client.post(path, {"mode": mode}).status, 204)
                event = socket.event()
                self.assertEqual((event.type, event.values), ("motionsystem-ev", {"change-count": count}))
            client.close()

    def test_positions_by_task(self):
        """RWS documentation: tasks/T/motion?resource=mechunit, robtarget, jointtarget, extjointstate."""
        for client in self.both():
            path = "/rw/rapid/tasks/T_ROB1/motion"
            self.assertEqual(client.get(path).status, 200)
            units = client.get(path + "?resource=mechunit").entries("rapid-mechunit")
            self.assertEqual([unit.values["name"] for unit in units], ["ROB_1", "STN1", "TRACK"])
            joints = client.get(path + "?resource=jointtarget").values("rapid-jointtarget")
            self.assertEqual([joints[f"j{axis}"] for axis in range(1, 7)], [joints[f"rax_{axis}"] for axis in range(1, 7)])
            self.assertIn("x", client.get(path + "?resource=robtarget").values("rapid-robtarget"))
            states = client.get(path + "?resource=extjointstate").values("rapid-extjointstate")
            self.assertEqual([states[f"j{axis}"] for axis in (3, 4, 5, 6)], ["not_active"] * 4)
            self.assertEqual(client.get(path + "?resource=odd").status, 400)


class SevenAxes(ServeCase):
    MODULE = "MODULE m\n PROC main()\n  WaitTime 1;\n ENDPROC\nENDMODULE\n"
    OPTIONS = ("--no-program-start", "--robot=IRB 14050-0.5/0.559")

    def test_kinematics(self):
        """Line 32 for an arm of seven axes: axis 7 is the first external one."""
        joints, seventh = [0.1, -0.5, 0.2, 0.3, 0.4, 0.5], 0.3
        for client in self.both():
            fields = {"rob_joints": str(joints), "ext_joints": f"[{seventh},9E9,9E9,9E9,9E9,9E9]"}
            values = client.act(UNIT, "CalcPoseFromJoints", fields, action2="pose-from-joints").values()
            pose = {"curr_position": str(numbers(values, [f"position-{c}" for c in "xyz"])),
                    "curr_orientation": str(numbers(values, [f"robtargetorientation-u{i}" for i in range(4)])),
                    "curr_ext_joints": f"[{values['arm-angle']},9E9,9E9,9E9,9E9,9E9]",
                    "old_rob_joints": str(joints), "old_ext_joints": f"[{seventh},9E9,9E9,9E9,9E9,9E9]"}
            back = client.act(UNIT, "JointsFromCartesian", pose, action2="joints-from-cartesian").values()
            for found, wanted in zip(numbers(back, [f"robotjoint{i}" for i in range(1, 8)]), joints + [seventh]):
                self.assertAlmostEqual(found, wanted, 4)
            listed = client.act(UNIT, "AllJointSolutions", pose, action2="all-joints-solution")
            self.assertTrue(listed.entries())
        self.assertEqual(self.client(1).get(UNIT + "?resource=static").values()["axes"], "7")


if __name__ == "__main__":
    main()
