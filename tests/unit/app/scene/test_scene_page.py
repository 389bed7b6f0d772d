"""viser's page, as the app serves it."""

import base64
import hashlib
import re

from app.scene.page import scene_page


def test_no_script_but_the_pages_own_two_may_run() -> None:
    page = scene_page()
    scripts = re.search(r"script-src ([^;]+)", page.policy)
    assert scripts is not None
    sources = scripts[1].split()
    assert [source[:8] for source in sources] == ["'sha256-", "'sha256-", "'wasm-un"]
    inline = re.findall(r"<script[^>]*>(.*?)</script>", page.html, re.DOTALL)
    digests = [base64.b64encode(hashlib.sha256(s.encode()).digest()).decode() for s in inline]
    assert [f"'sha256-{digest}'" for digest in digests] == sources[:1]
    assert "unsafe-eval'" not in page.policy.replace("wasm-unsafe-eval", "")


def test_it_reaches_and_is_shown_by_the_console_alone() -> None:
    policy = scene_page().policy
    assert "default-src 'none'" in policy
    assert "connect-src 'self' data: blob:" in policy
    assert "frame-ancestors 'self'" in policy
    assert "http" not in policy


def test_the_panel_of_visers_own_is_not_shown() -> None:
    style, _, rest = scene_page().html.partition("</head>")
    assert style.endswith("{ display: none !important }</style>")
    assert "<body>" in rest
