"""What the checkers of Gymnasium (`gymnasium.utils.env_checker.check_env`) and
PettingZoo (`api_test`, `parallel_api_test`) look at by their documentation, as
checks of our own: neither package is in Debian. Where they are installed,
test_environments calls theirs, too.

Each takes a function that makes a new environment, and a test case."""
import math


def _in(space, x, case, what: str) -> None:
    case.assertTrue(space.contains(x), f"{what}: {x} is not in {space}")
    case.assertTrue(all(math.isfinite(v) for v in x), what)


def check_gymnasium(make, case) -> None:
    """Spaces, reset, seeds, step, close."""
    env = make()
    case.assertIs(env.unwrapped, env)
    case.assertIsInstance(env.metadata["render_modes"], list)
    case.assertIsNone(env.render_mode)
    _check_bounds(env.observation_space, case)
    case.assertGreater(env.action_space.n, 1)
    with case.assertRaises(RuntimeError):
        env.step(0)  # before reset
    result = env.reset(options={})
    case.assertIsInstance(result, tuple)
    case.assertEqual(len(result), 2)
    _in(env.observation_space, result[0], case, "reset()")
    case.assertIsInstance(result[1], dict)
    same = [list(env.reset(seed=123)[0]) for _ in range(2)]
    case.assertEqual(*same)
    over = False
    env.reset(seed=1)
    while not over:
        result = env.step(env.action_space.sample(env.action_masks()))
        case.assertEqual(len(result), 5)
        seen, reward, terminated, truncated, info = result
        _in(env.observation_space, seen, case, "step()")
        case.assertIsInstance(reward, float)
        case.assertTrue(math.isfinite(reward))
        case.assertIs(type(terminated), bool)
        case.assertIs(type(truncated), bool)
        case.assertIsInstance(info, dict)
        over = terminated or truncated
    with case.assertRaises(RuntimeError):
        env.step(0)  # after the end
    env.reset(seed=1)
    with case.assertRaises(ValueError):
        env.step(env.action_space.n)
    case.assertIsNone(env.render())
    env.close()
    env.close()


def _check_bounds(space, case) -> None:
    case.assertEqual(len(space.shape), 1)
    case.assertEqual(len(space.low), space.shape[0])
    for low, high in zip(space.low, space.high):
        case.assertLess(low, high)
        case.assertTrue(math.isfinite(low) and math.isfinite(high))


def check_aec(make, case) -> None:
    """Spaces, the order of acting, accumulated rewards, agents that end."""
    env = make()
    env.reset(seed=1)
    case.assertGreater(env.num_agents, 0)
    case.assertEqual(env.agents, env.possible_agents)
    case.assertFalse(any(env.terminations.values()))
    case.assertFalse(any(env.truncations.values()))
    for agent in env.agents:
        case.assertRegex(agent, "^[a-z]+_[0-9]+$")
        case.assertIs(env.observation_space(agent),
                      env.observation_space(agent))
        case.assertIs(env.action_space(agent), env.action_space(agent))
        case.assertEqual(env.action_space(agent).n,
                         env.action_space(env.agents[0]).n)
        _check_bounds(env.observation_space(agent), case)
    case.assertIsNone(env.last(observe=False)[0])
    _play_in_turn(env, case)
    env.reset(seed=1)
    case.assertEqual(env.agents, env.possible_agents)
    with case.assertRaises(ValueError):
        env.step(env.action_space(env.agent_selection).n)
    env.close()
    env.close()


def _play_in_turn(env, case) -> None:
    earned = dict.fromkeys(env.agents, 0.0)
    alive, done = list(env.agents), set()
    for agent in env.agent_iter():
        case.assertEqual(agent, env.agent_selection)
        seen, reward, terminated, truncated, info = env.last()
        _in(env.observation_space(agent), seen, case, agent)
        case.assertEqual(reward, earned[agent], agent)
        case.assertEqual(info, env.infos[agent])
        case.assertEqual((terminated, truncated),
                         (env.terminations[agent], env.truncations[agent]))
        over = terminated or truncated
        case.assertNotIn(agent, done)
        action = None if over else env.action_space(agent).sample(
            info["action_mask"])
        case.assertIsNone(env.step(action))
        earned[agent] = 0.0
        for other, x in env.rewards.items():
            earned[other] += x
        if over:
            alive.remove(agent)
            done.add(agent)
        case.assertEqual(env.agents, alive)
        case.assertEqual(env.num_agents, len(alive))
        for of_agents in (env.rewards, env.terminations, env.truncations,
                          env.infos):
            case.assertEqual(set(of_agents), set(alive))
    case.assertEqual(done, set(env.possible_agents))
    with case.assertRaises(RuntimeError):
        env.step(None)


def check_parallel(make, case) -> None:
    """Keys of all that is returned, agents that end, seeds."""
    env = make()
    for _ in range(2):
        seen, infos = env.reset(seed=1)
        case.assertEqual(env.agents, env.possible_agents)
        case.assertEqual(set(seen), set(env.agents))
        case.assertEqual(set(infos), set(env.agents))
        while env.agents:
            before = list(env.agents)
            actions = {x: env.action_space(x).sample(infos[x]["action_mask"])
                       for x in before}
            result = env.step(actions)
            case.assertEqual(len(result), 5)
            for of_agents in result:
                case.assertEqual(set(of_agents), set(before))
            seen, rewards, terminations, truncations, infos = result
            for agent in before:
                _in(env.observation_space(agent), seen[agent], case, agent)
                case.assertTrue(math.isfinite(rewards[agent]))
                over = terminations[agent] or truncations[agent]
                case.assertEqual(agent not in env.agents, over)
        with case.assertRaises(RuntimeError):
            env.step({})
    env.reset()
    with case.assertRaises(ValueError):
        env.step({env.agents[0]: -1})
    env.close()
    env.close()
