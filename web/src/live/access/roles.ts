// What somebody may do, and the sentence for what they may not. Pure.

export const ROLES = ["viewer", "operator", "engineer", "admin"] as const;
export type Role = (typeof ROLES)[number];

/** What each role adds to the one before it. */
export const MAY: Readonly<Record<Role, string>> = {
  viewer: "Looks at everything, and stops the rig",
  operator: "Commands the rig, writes and runs tests",
  engineer: "Changes interlocks, injects faults, takes over command, reads the audit",
  admin: "Keeps users and tokens",
};

export const atLeast = (role: Role | null, needed: Role): boolean =>
  role !== null && ROLES.indexOf(role) >= ROLES.indexOf(needed);

const one = (role: Role): string => `${/^[aeiou]/.test(role) ? "an" : "a"} ${role}`;

/** Why a role may not; null where it may. */
export function lacking(role: Role | null, needed: Role): string | null {
  if (atLeast(role, needed)) return null;
  return role === null ? `Needs ${one(needed)}: sign in` : `Needs ${one(needed)}; you are ${one(role)}`;
}
